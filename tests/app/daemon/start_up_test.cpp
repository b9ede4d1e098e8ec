// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <bitset>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "app/cli/keys/keystore.h"
#include "tests/app/daemon/daemon_program.h"
#include "tests/support/network_namespace.h"
#include "tests/support/share.h"

/// `orbwatchd` that is started while devices and networks are missing, and gets them later.
namespace orbwatch::tests {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

/// Parts that can be missing.
enum Thing : std::size_t { CameraA, CameraB, Line, ModbusAddress, DdsInterface, Certificate };
constexpr std::size_t kThings = 6;
using Missing = std::bitset<kThings>;

constexpr const char* kModbusAddress = "10.77.1.1";
constexpr const char* kDdsAddress = "10.77.2.1";

const std::string kLine = R"(
[[line]]
name = "door"
use = "process_input"
back_end = "simulated"
line_name = "DOOR"
[simulation]
connected = "connected"
)";

class StartUp : public Daemon {
 protected:
  void SetUp() override {
    ORBWATCH_REQUIRE_NETWORK_NAMESPACES();
    make_keys("valid", std::chrono::hours(-24));
    make_keys("early", std::chrono::hours(24 * 20));
  }

  /// Makes keys valid from `from`, relative to now.
  void make_keys(const std::string& name, std::chrono::hours from) const {
    const auto now = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
    const auto made = app::cli::make_keys({folder / name,
                                           {kDomain, kDomain},
                                           100,
                                           app::cli::appliance_access("orbwatch"),
                                           app::cli::controller_access("orbwatch"),
                                           app::cli::bulk_topics("orbwatch")},
                                          now + from);
    ASSERT_TRUE(made) << made.error().message;
  }

  /// Starts with everything except the missing parts.
  void begin(const Missing& missing) {
    fs::remove_all(folder / "connected");
    fs::create_directory(folder / "connected");
    fs::remove(folder / "keys");
    fs::create_directory_symlink("early", folder / "keys");
    missing_.set();
    for (std::size_t thing = 0; thing < kThings; ++thing) {
      if (!missing[thing]) arrive(static_cast<Thing>(thing));
    }
    const std::string dds =
        "<CycloneDDS><Domain><General><Interfaces><NetworkInterface address=\"" +
        std::string(kDdsAddress) +
        "\"/></Interfaces><AllowMulticast>false</AllowMulticast></General><Discovery>"
        "<ParticipantIndex>auto</ParticipantIndex><Peers><Peer address=\"" +
        kDdsAddress + "\"/></Peers></Discovery></Domain></CycloneDDS>";
    setenv("CYCLONEDDS_URI", dds.c_str(), 1);
  }

  void arrive(Thing thing) {
    missing_[thing] = false;
    const auto connect = [this](const char* name) {
      std::ofstream(folder / "connected" / name).flush();
    };
    switch (thing) {
      case CameraA:
        return connect("colour");
      case CameraB:
        return connect("thermal");
      case Line:
        return connect("DOOR");
      case ModbusAddress:
        return ip(std::string("address add ") + kModbusAddress + "/32 dev lo");
      case DdsInterface:
        ip("link add dds0 type veth peer name dds1");
        ip(std::string("address add ") + kDdsAddress + "/24 dev dds0");
        ip("link set dds1 up");
        return ip("link set dds0 up");
      case Certificate:
        fs::create_directory_symlink("valid", folder / "new");
        return fs::rename(folder / "new", folder / "keys");
    }
  }

  std::string config() const {
    const std::string file = write_config("[dds.security]\nfolder = \"keys/enclaves/appliance\"\n" +
                                          small_machine() + kLine);
    replace_in(file, "127.0.0.1", kModbusAddress);
    replace_in(file, "domain = " + std::to_string(domain), "domain = " + std::to_string(kDomain));
    return file;
  }
  static void replace_in(const std::string& file, const std::string& what,
                         const std::string& with) {
    std::stringstream text;
    text << std::ifstream(file).rdbuf();
    std::string all = text.str();
    all.replace(all.find(what), what.size(), with);
    std::ofstream(file) << all;
  }

  std::int64_t reads(const std::string& name) const {
    return read_register(port, name, kModbusAddress);
  }
  /// State of the system over DDS, as JSON.
  std::string state() const {
    Subprocess program(
        {ORBWATCH_PROGRAM, "state", "--json", "--timeout", "60", "--domain",
         std::to_string(kDomain), "--security", (folder / "valid/enclaves/subscriber").string()},
        folder / "said");
    program.wait();
    return program.output();
  }

  std::int64_t lines_missing() const { return missing_[Line] ? 1 : 0; }
  std::int64_t interfaces_missing() const {
    const bool dds = missing_[DdsInterface] || missing_[Certificate];
    return (missing_[ModbusAddress] ? 2 : 0) + (dds ? 4 : 0);
  }
  /// Expected state; 1: running, 2: degraded, 3: fault.
  std::int64_t state_expected() const {
    return missing_[CameraA] && missing_[CameraB]   ? 3
           : missing_[CameraA] || missing_[CameraB] ? 2
                                                    : 1;
  }
  bool says_so_over_modbus() const {
    return reads("system_state") == state_expected() &&
           (reads("camera_0_fault") != 0) == missing_[CameraA] &&
           (reads("camera_1_fault") != 0) == missing_[CameraB] &&
           reads("system_line_faults") == lines_missing() &&
           reads("system_process_inputs_known") == 1 - lines_missing() &&
           reads("system_interface_faults") == interfaces_missing();
  }
  bool says_so_over_dds() const {
    const std::string said = state();
    const auto has = [&said](const std::string& name, std::int64_t value) {
      return said.find("\"" + name + "\":" + std::to_string(value)) != std::string::npos;
    };
    return has("line_faults", lines_missing()) && has("interface_faults", interfaces_missing());
  }
  /// Checks the reports of the interfaces that are available.
  void expect_that_it_says_so(Subprocess& daemon) const {
    if (!missing_[ModbusAddress]) {
      EXPECT_TRUE(eventually(daemon, [this] { return says_so_over_modbus(); })) << missing_ << "\n"
                                                                                << daemon.output();
    }
    if (!missing_[DdsInterface] && !missing_[Certificate]) {
      EXPECT_TRUE(eventually(daemon, [this] { return says_so_over_dds(); }))
          << missing_ << "\n"
          << state() << daemon.output();
    }
    EXPECT_TRUE(daemon.runs()) << daemon.output();
  }

  static constexpr int kDomain = 7;
  Missing missing_;
};

TEST_F(StartUp, GoesOnWithoutWhatIsMissingAndIsCompleteWhenItHasCome) {
  DrawnShare share(1 << kThings);
  for (unsigned long subset = 0; subset < 1UL << kThings; ++subset) {
    if (!share.next()) continue;
    SCOPED_TRACE("missing " + Missing(subset).to_string());
    const NetworkNamespace network;
    network.run([&] {
      begin(Missing(subset));
      Subprocess daemon = start(config());
      expect_that_it_says_so(daemon);
      std::vector<std::size_t> order{CameraA,       CameraB,      Line,
                                     ModbusAddress, DdsInterface, Certificate};
      std::shuffle(order.begin(), order.end(), std::mt19937(static_cast<unsigned>(subset)));
      for (const std::size_t thing : order) {
        if (missing_[thing]) arrive(static_cast<Thing>(thing));
      }
      expect_that_it_says_so(daemon);
      daemon.send(SIGTERM);
      EXPECT_EQ(daemon.wait(), 0) << daemon.output();
    });
  }
}

TEST_F(StartUp, TheLogNamesEachMissingThingAndItsArrival) {
  const NetworkNamespace network;
  network.run([&] {
    begin(Missing().set());
    Subprocess daemon = start(config());
    ASSERT_TRUE(eventually(daemon, [&] {
      return daemon.output().find("runs with 2 cameras") != std::string::npos;
    })) << daemon.output();
    for (std::size_t thing = 0; thing < kThings; ++thing) arrive(static_cast<Thing>(thing));
    expect_that_it_says_so(daemon);
    const std::string log = daemon.output();
    for (const char* text :
         {"camera colour: ", "camera thermal: ", "door: line is not there", "10.77.1.1",
          "is valid from", "camera colour: is there", "modbus: is there", "door: line works"}) {
      const auto first = log.find(text);
      EXPECT_NE(first, std::string::npos) << text << "\n" << log;
    }
  });
}

TEST_F(StartUp, AWrongKeyFileIsRefused) {
  const NetworkNamespace network;
  network.run([&] {
    begin({});
    std::ofstream(folder / "valid/enclaves/appliance/governance.p7s") << "nothing";
    Subprocess daemon = start(config());
    EXPECT_EQ(daemon.wait(), 1);
    EXPECT_THAT(daemon.output(), HasSubstr("governance.p7s"));
  });
}

}  // namespace
}  // namespace orbwatch::tests
