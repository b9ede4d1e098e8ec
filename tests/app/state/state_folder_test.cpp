// SPDX-License-Identifier: Apache-2.0
#include "app/state/state_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/support/service_user.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;

/// A board's /var/lib, and the shell of a user, without STATE_DIRECTORY.
class StateFolder : public testing::Test {
 protected:
  StateFolder() { ::unsetenv("STATE_DIRECTORY"); }
  ~StateFolder() override { ::unsetenv("STATE_DIRECTORY"); }

  /// Records the folder like orbwatchd at its start.
  void runs_with(const std::string& folder, const fs::path& configuration) const {
    EXPECT_TRUE(record_owner(lib() / folder, configuration));
  }
  std::string found(const fs::path& configuration) const {
    const auto folder = state_folder({}, configuration, lib());
    return folder ? folder->lexically_relative(lib()).string() : folder.error().message;
  }
  const fs::path& lib() const { return folder_.path(); }

  const fs::path first_ = "/etc/orbwatch/site.toml", second_ = "/etc/orbwatch/press/site.toml";
  const orbwatch::tests::TemporaryFolder folder_;
};

TEST_F(StateFolder, IsTheConfiguredOneThenSystemdsThenTheUnits) {
  ::setenv("STATE_DIRECTORY", "/var/lib/one:/var/lib/two", 1);
  EXPECT_EQ(state_folder("/data/orbwatch", first_, lib()).value(), "/data/orbwatch");
  EXPECT_EQ(state_folder({}, first_, lib()).value(), "/var/lib/one");
  ::setenv("STATE_DIRECTORY", "", 1);
  EXPECT_EQ(found(first_), "orbwatch");
  ::unsetenv("STATE_DIRECTORY");
  EXPECT_EQ(found(first_), "orbwatch");
  EXPECT_EQ(found(second_), "orbwatch-press");
  EXPECT_EQ(found("/etc/orbwatch/press/../other/./site.toml"), "orbwatch-other");
  EXPECT_EQ(found("/home/kim/site.toml"), "orbwatch") << "nothing else ran on this board";
}

TEST_F(StateFolder, IsTheOneInWhichTheConfigurationRuns) {
  runs_with("orbwatch", "/data/first.toml");
  runs_with("orbwatch-lathe", "/data/lathe.toml");
  EXPECT_EQ(found("/data/first.toml"), "orbwatch");
  EXPECT_EQ(found("/data/lathe.toml"), "orbwatch-lathe");
  EXPECT_EQ(found(second_), "orbwatch-press") << "it did not run yet";
  std::ofstream(lib() / "real.toml") << "";
  fs::create_symlink(lib() / "real.toml", lib() / "link.toml");
  runs_with("orbwatch-third", lib() / "link.toml");
  EXPECT_EQ(found(lib() / "real.toml"), "orbwatch-third");
}

TEST_F(StateFolder, OfAnotherConfigurationIsRefusedWithWhatToSay) {
  runs_with("orbwatch", "/data/first.toml");
  EXPECT_THAT(found(first_), AllOf(HasSubstr("orbwatch: is the state folder of /data/first.toml"),
                                   HasSubstr("not of /etc/orbwatch/site.toml"),
                                   HasSubstr("pass --config /data/first.toml")));
  EXPECT_THAT(found("/home/kim/site.toml"), HasSubstr("STATE_DIRECTORY=FOLDER"));

  runs_with("orbwatch-press", second_);
  ::setenv("STATE_DIRECTORY", (lib() / "orbwatch").c_str(), 1);
  EXPECT_THAT(found(second_), HasSubstr("STATE_DIRECTORY=" + (lib() / "orbwatch-press").string()));
  EXPECT_EQ(found("/data/first.toml"), "orbwatch");
}

TEST_F(StateFolder, OfAServiceIsNotGuessedByAnotherUser) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  runs_with("orbwatch", first_);
  fs::permissions(lib(), fs::perms(0755));
  fs::permissions(lib() / "orbwatch", fs::perms(0750));
  EXPECT_TRUE(orbwatch::tests::as_user(orbwatch::tests::kStranger, 077, [this] {
    const std::string denied = "may look into it; run the command with sudo";
    return found(first_).ends_with(denied) && found("/home/kim/site.toml").ends_with(denied);
  }));
}

TEST_F(StateFolder, OneOfSeveralIsNotGuessed) {
  runs_with("orbwatch-old", "/data/site.toml");
  runs_with("orbwatch-new", "/data/site.toml");
  EXPECT_THAT(found("/data/site.toml"),
              AllOf(HasSubstr("several"), HasSubstr("orbwatch-old"), HasSubstr("orbwatch-new")));
  runs_with("orbwatch", "/data/site.toml");
  EXPECT_EQ(found("/data/site.toml"), "orbwatch") << "the unit's own";
}

TEST_F(StateFolder, ChangesItsOwnerWithTheUnit) {
  EXPECT_EQ(owner_of(lib()), std::nullopt);
  EXPECT_EQ(record_owner(lib() / "new", first_).value(), std::nullopt);
  EXPECT_EQ(owner_of(lib() / "new"), first_);
  EXPECT_EQ(record_owner(lib() / "new", first_).value(), std::nullopt) << "nothing changes";
  EXPECT_EQ(record_owner(lib() / "new", second_).value(), first_);
  EXPECT_EQ(owner_of(lib() / "new"), second_);
  EXPECT_FALSE(record_owner("/proc/orbwatch", first_));
}

}  // namespace
}  // namespace orbwatch::app
