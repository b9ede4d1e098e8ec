// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "app/exit_status.h"
#include "tests/app/daemon/daemon_program.h"
#include "tests/support/notify_socket.h"

/// `orbwatchd` that a digital line asks to stop: a pulse of its own, on a wire back to it, stands
/// for the supply.
namespace orbwatch::tests {
namespace {

using app::CommandCode;
using app::CommandResult;
using app::ExitStatus;
using testing::HasSubstr;
namespace fs = std::filesystem;

class StopLine : public Daemon {
 protected:
  /// The machine with a stop line that has these keys, too.
  std::string config(const std::string& keys) const {
    return write_config(small_machine() + R"(
[recorder]
folder = "recordings"
[recorder.events]
before_s = 0.2
after_s = 60
longest_s = 240
ring_mib = 64
[[line]]
name = "supply"
use = "stop"
back_end = "simulated"
line_name = "UPS"
hold_ms = 50
)" + keys + R"(
[[line]]
name = "failure"
use = "trigger_out"
back_end = "simulated"
line_name = "UPS"
width_us = 5000000
)");
  }
  void fail_supply(Subprocess& daemon) {
    ASSERT_EQ(command(daemon, CommandCode::Pulse, {0}), CommandResult::Done) << daemon.output();
  }
};

int number(ExitStatus status) { return static_cast<int>(status); }

TEST_F(StopLine, AsksForThePowerToBeSwitchedOff) {
  Subprocess daemon = start(config(""));
  ASSERT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 0; })) << daemon.output();
  fail_supply(daemon);
  EXPECT_EQ(daemon.wait(), number(ExitStatus::PowerOff)) << daemon.output();
  EXPECT_THAT(daemon.output(), HasSubstr("line supply asks for a stop and power-off"));
}

TEST_F(StopLine, StopsOnlyAndFinishesTheEventThatIsBeingRecorded) {
  const NotifySocket manager(folder / "notify", std::chrono::seconds(10));
  Subprocess daemon = start(config("power_off = false\n"));
  ASSERT_TRUE(eventually(daemon, [&] { return read("system_frame_set") > 10; })) << daemon.output();
  ASSERT_EQ(command(daemon, CommandCode::RecordEvent), CommandResult::Done);
  const fs::path events = folder / "recordings" / "events";
  const auto is_begun = [&] {
    std::error_code none;
    return fs::exists(events, none) && !fs::is_empty(events, none);
  };
  ASSERT_TRUE(eventually(daemon, is_begun)) << daemon.output();
  fail_supply(daemon);
  manager.await("STOPPING=1");
  EXPECT_EQ(daemon.wait(), number(ExitStatus::StopLine)) << daemon.output();
  EXPECT_THAT(daemon.output(), HasSubstr("line supply asks for a stop\n"));
  EXPECT_THAT(daemon.output(), Not(HasSubstr("ends without waiting")));
  ASSERT_EQ(std::distance(fs::directory_iterator(events), {}), 1);
  EXPECT_TRUE(fs::exists(fs::directory_iterator(events)->path() / "summary.json"));
}

}  // namespace
}  // namespace orbwatch::tests
