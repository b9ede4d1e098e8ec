// SPDX-License-Identifier: Apache-2.0
#include <cstdio>

#include "tests/app/daemon/daemon_program.h"
#include "tests/support/reference_data.h"

/// PLC by pymodbus beside the running program.
namespace orbwatch::tests {
namespace {

constexpr const char* kPython = "/usr/bin/python3";  // Debian's, for which its pymodbus is built
constexpr const char* kPymodbus = "/usr/lib/python3/dist-packages/pymodbus";

class DaemonPlc : public Daemon {
 protected:
  void SetUp() override { ORBWATCH_REQUIRE_FILE(kPymodbus); }

  /// Output of a program of tests/app/ports/modbus for this daemon.
  std::string run(const std::string& program, const std::vector<std::string>& arguments = {}) {
    std::vector<std::string> words{
        kPython, ORBWATCH_SOURCE_DIR "/tests/app/ports/modbus/" + program, std::to_string(port)};
    words.insert(words.end(), arguments.begin(), arguments.end());
    Subprocess plc(words, folder / "plc.log");
    EXPECT_EQ(plc.wait(), 0) << plc.output();
    return plc.output();
  }
};

TEST_F(DaemonPlc, ReadsTheWholeMap) {
  Subprocess daemon = start(write_config(small_machine()));
  ASSERT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 5; })) << daemon.output();
  run("walk_registers.py");
  EXPECT_EQ(read("map_version"), 3);
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
}

TEST_F(DaemonPlc, TriggersMeasuresAndTakesResults) {
  Subprocess daemon = start(write_config(small_machine()));
  ASSERT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 5; })) << daemon.output();
  const std::string said = run("plc_program.py", {"40", "20240508", "--any"});
  int triggered = 0, parts = 0, lost = 0;
  std::sscanf(said.c_str(), "triggered %d parts %d lost %d", &triggered, &parts, &lost);
  EXPECT_EQ(triggered, 40);
  EXPECT_EQ(parts, 40);
  EXPECT_EQ(lost, 0);
  EXPECT_EQ(read("system_result"), 40);
  EXPECT_EQ(read("result_count"), 0);
  EXPECT_EQ(read("system_recipe"), 1);
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
}

TEST_F(DaemonPlc, SeesTheToolWhereItIsAtEachExposure) {
  Subprocess daemon = start(write_config(small_machine() + "[machine]\nsource = \"modbus\"\n"));
  ASSERT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 5; })) << daemon.output();
  EXPECT_EQ(read("machine_quality"), 3);  // no state has arrived
  const std::string said = run("machine_controller.py", {"300"});
  int compared = 0;
  double p90 = 100, p99 = 100;
  std::sscanf(said.c_str(), "compared %d p90 %lf p99 %lf", &compared, &p90, &p99);
  EXPECT_EQ(compared, 300);
  // The tests of the follower judge 99 of 100, without a scheduler between the clocks.
  EXPECT_LE(p90, 2) << said;
  EXPECT_NE(read("fault_bits") & 1 << 8, 0);
  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
}

}  // namespace
}  // namespace orbwatch::tests
