// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "tests/app/daemon/daemon_program.h"

/// `orbwatchd` in a DDS domain that only holders of keys may join, starting with making the keys.
namespace orbwatch::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class SecureDaemon : public Daemon {
 protected:
  /// Runs `orbwatch`; returns its exit code and keeps its output.
  int orbwatch(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), ORBWATCH_PROGRAM);
    Subprocess program(arguments, folder / "said");
    const int code = program.wait();
    said = program.output();
    return code;
  }
  /// Runs a command of DDS with the keys of `name`, or none.
  int ask(std::vector<std::string> arguments, const std::string& name = "") {
    std::vector<std::string> options{"--domain", std::to_string(domain)};
    if (!name.empty()) {
      options.insert(options.end(), {"--security", (folder / "keys" / "enclaves" / name).string()});
    }
    arguments.insert(arguments.begin() + 1, options.begin(), options.end());
    return orbwatch(arguments);
  }
  std::string keys() const { return (folder / "keys").string(); }
  std::string secured_config() const {
    return write_config("[dds.security]\nfolder = \"keys/enclaves/appliance\"\n" + small_machine());
  }

  std::string said;
};

TEST_F(SecureDaemon, IsSeenAndCommandedWithItsKeysOnly) {
  ASSERT_EQ(
      orbwatch({"dds-keys", keys(), "--domain", std::to_string(domain), "--subscriber", "plc"}), 0)
      << said;
  ASSERT_EQ(orbwatch({"dds-keys", keys(), "--domain", std::to_string(domain), "--subscriber",
                      "office", "--read-only"}),
            0)
      << said;
  Subprocess daemon = start(secured_config());
  EXPECT_EQ(ask({"state", "--timeout", "60"}, "office"), 0) << said << daemon.output();
  EXPECT_THAT(said, HasSubstr("running: every camera delivers"));
  EXPECT_EQ(ask({"subscribe", "--topic", "orbwatch/room/image_raw", "--count", "1", "--seconds",
                 "60", "--save", folder.path().string()},
                "office"),
            0)
      << said;
  EXPECT_TRUE(std::filesystem::exists(folder / "room.png"));
  EXPECT_EQ(ask({"command", "--timeout", "60", "select_view", "1"}, "plc"), 0) << said;
  EXPECT_TRUE(eventually(daemon, [&] { return read("system_selected_view") == 1; }));

  EXPECT_EQ(ask({"command", "select_view", "0"}, "office"), 1);
  EXPECT_THAT(said, HasSubstr("Not Allowed By Security"));
  EXPECT_EQ(ask({"command", "--timeout", "1", "select_view", "0"}), 1);
  EXPECT_THAT(said, HasSubstr("nobody accepts commands"));
  EXPECT_EQ(read("system_selected_view"), 1) << "nobody else's command came through";

  daemon.send(SIGTERM);
  EXPECT_EQ(daemon.wait(), 0) << daemon.output();
}

TEST_F(SecureDaemon, SaysWhichKeyIsMissingInOneLine) {
  const std::string config = secured_config();
  Subprocess check({ORBWATCHD_PROGRAM, "--config", config, "--check"}, folder / "check.log");
  EXPECT_EQ(check.wait(), 1);
  EXPECT_THAT(check.output(), HasSubstr("keys/enclaves/appliance/identity_ca.cert.pem"));
  Subprocess daemon = start(config);
  EXPECT_EQ(daemon.wait(), 1);
  EXPECT_THAT(daemon.output(), AllOf(HasSubstr("keys/enclaves/appliance/identity_ca.cert.pem"),
                                     HasSubstr("No such file")));
}

}  // namespace
}  // namespace orbwatch::tests
