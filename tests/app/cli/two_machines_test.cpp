// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <cstdlib>

#include "app/files/runtime/trial.h"
#include "app/ports/web/access/users.h"
#include "app/state/state_folder.h"
#include "tests/app/cli/command_line.h"
#include "tests/app/files/machine_files.h"

/// Two machines on one board, and a shell whose state folder is that of the first one, such as the
/// default /var/lib/orbwatch.
namespace orbwatch::tests {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class TwoMachines : public CommandLine {
 protected:
  void SetUp() override {
    write("rig.toml", app::files::kRig);
    write("first.toml", app::files::kValid);
    write("second.toml", app::files::kValid + "[console]\nenabled = true\n");
    ASSERT_TRUE(app::record_owner(state(), path("first.toml")));
    ::setenv("STATE_DIRECTORY", state().c_str(), 1);
  }
  void TearDown() override { ::unsetenv("STATE_DIRECTORY"); }

  std::filesystem::path state() const { return folder.path() / "state"; }
  /// Full path, as recorded.
  std::string first() const {
    return std::filesystem::path(path("first.toml")).lexically_normal().string();
  }
  /// A command for the second machine changes nothing at the first one.
  void expect_refused(std::vector<std::string> words) {
    words.insert(words.end(), {"--config", path("second.toml")});
    EXPECT_NE(run(words), 0) << said;
    EXPECT_THAT(
        said, AllOf(HasSubstr("is the state folder of " + first()), HasSubstr("STATE_DIRECTORY=")));
    EXPECT_EQ(std::distance(std::filesystem::directory_iterator(state()), {}), 1)
        << "its owner only";
  }
};

TEST_F(TwoMachines, NoCommandForTheSecondReachesTheFirst) {
  expect_refused({"configure", path("second.toml")});
  expect_refused({"configure", "--confirm"});
  expect_refused({"configure", "--cancel"});
  expect_refused({"password"});
  expect_refused({"password", "--show"});
  expect_refused({"calibration", "history"});
  expect_refused({"calibration", "reset", "a"});
  expect_refused({"lines", "--safe"});
  expect_refused({"doctor"});
}

TEST_F(TwoMachines, TheFirstIsReached) {
  EXPECT_EQ(run({"calibration", "history", "--config", path("first.toml")}), 0) << said;
  EXPECT_EQ(run({"lines", "--safe", "--config", path("first.toml")}), 0) << said;
}

/// A copy of a site may be tried out in any folder.
TEST_F(TwoMachines, FilesOfTheSecondAreReadWithoutAState) {
  Subprocess check({ORBWATCHD_PROGRAM, "--config", path("second.toml"), "--check"},
                   folder.path() / "checked");
  EXPECT_EQ(check.wait(), 0) << check.output();
}

}  // namespace
}  // namespace orbwatch::tests
