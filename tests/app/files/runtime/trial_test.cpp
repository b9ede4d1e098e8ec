// SPDX-License-Identifier: Apache-2.0
#include "app/files/runtime/trial.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "app/files/text/file_version.h"
#include "tests/support/temporary_folder.h"

namespace {

std::function<void(int)> on_fsync;  // called before fsync is executed

}  // namespace

/// Replaces the function of the C library in this program.
extern "C" int fsync(int file) {
  if (on_fsync) on_fsync(file);
  return static_cast<int>(::syscall(SYS_fsync, file));
}

namespace orbwatch::app::files {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

bool is_folder(int file, const fs::path& folder) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(file, &opened) == 0 && ::stat(folder.c_str(), &named) == 0 &&
         opened.st_dev == named.st_dev && opened.st_ino == named.st_ino;
}

class TrialFile : public testing::Test {
 protected:
  const tests::TemporaryFolder folder_;
  const fs::path requested_ = folder_ / "trial.json";
};

TEST_F(TrialFile, IsTakenOnceAndRunsUntilItsEnd) {
  EXPECT_EQ(take_trial(folder_.path()).value(), std::nullopt);
  ASSERT_TRUE(
      request_trial(folder_.path(), {"/etc/site.toml", {{"/etc/rig.toml", "x"}}, 30, {}, "kim"}));
  EXPECT_TRUE(is_trial_requested(folder_.path()));
  const auto taken = take_trial(folder_.path());
  ASSERT_TRUE(taken && *taken);
  EXPECT_EQ((*taken)->site, "/etc/site.toml");
  EXPECT_EQ((*taken)->seconds, 30);
  EXPECT_EQ((*taken)->texts.at("/etc/rig.toml"), "x");
  EXPECT_EQ((*taken)->owner, "kim");
  EXPECT_FALSE(is_trial_requested(folder_.path()));
  EXPECT_TRUE(running_trial(folder_.path()).value());
  EXPECT_TRUE(end_trial(folder_.path()));
  EXPECT_EQ(running_trial(folder_.path()).value(), std::nullopt);
}

/// Without this, a trial that resets the board would be requested again at each boot.
TEST_F(TrialFile, IsTakenForGoodBeforeItRuns) {
  ASSERT_TRUE(request_trial(folder_.path(), {"/etc/site.toml", {}, 30}));
  int synced = 0;
  on_fsync = [&](int file) {
    if (is_folder(file, folder_.path()) && !fs::exists(requested_)) ++synced;
  };
  const auto taken = take_trial(folder_.path());
  on_fsync = nullptr;
  EXPECT_TRUE(taken && *taken);
  EXPECT_EQ(synced, 1) << "the folder, after the request is gone";
}

TEST_F(TrialFile, IsForgottenWhenItIsRefused) {
  ASSERT_TRUE(request_trial(folder_.path(), {"/etc/site.toml", {}, 30}));
  drop_request(folder_.path());
  EXPECT_FALSE(is_trial_requested(folder_.path()));
  drop_request(folder_.path());
}

TEST_F(TrialFile, IsCancelledBeforeItRunsAndWhileItRuns) {
  EXPECT_THAT(cancel_trial(folder_.path()).error().message, HasSubstr("no configuration waits"));
  ASSERT_TRUE(request_trial(folder_.path(), {"/etc/site.toml", {}, 30}));
  EXPECT_TRUE(cancel_trial(folder_.path()));
  EXPECT_EQ(take_trial(folder_.path()).value(), std::nullopt);
  ASSERT_TRUE(request_trial(folder_.path(), {"/etc/site.toml", {}, 30}));
  ASSERT_TRUE(take_trial(folder_.path()));
  EXPECT_TRUE(cancel_trial(folder_.path()));
  EXPECT_EQ(running_trial(folder_.path()).value(), std::nullopt);
}

/// Its texts may repeat a file that is not world-readable.
TEST_F(TrialFile, IsForItsOwnerAlone) {
  ASSERT_TRUE(request_trial(folder_.path(), {"/etc/site.toml", {}, 30}));
  EXPECT_EQ(fs::status(requested_).permissions(), fs::perms(0600));
}

TEST_F(TrialFile, ReportsWhatBecameOfIt) {
  EXPECT_EQ(trial_report(folder_.path()).value(), std::nullopt);
  ASSERT_TRUE(report_trial(folder_.path(), "a lens of \xff"));
  EXPECT_THAT(trial_report(folder_.path()).value().value(), HasSubstr("a lens of "));
  ASSERT_TRUE(request_trial(folder_.path(), {"/etc/site.toml", {}, 30}));
  EXPECT_EQ(trial_report(folder_.path()).value(), std::nullopt) << "it is of another one";
}

TEST_F(TrialFile, ThatIsDamagedIsRefused) {
  for (const char* text : {"", "{", "[]", "{\"site\": 1}"}) {
    std::ofstream(requested_) << text;
    EXPECT_THAT(take_trial(folder_.path()).error().message, HasSubstr("is damaged")) << text;
  }
}

TEST_F(TrialFile, IsWrittenWhereItDiffersOnceItIsConfirmed) {
  const fs::path site = folder_ / "site.toml", rig = folder_ / "rig.toml";
  std::ofstream(site) << "old";
  std::ofstream(rig) << "same";
  ASSERT_TRUE(request_trial(folder_.path(), {site, {{site, "new"}, {rig, "same"}}, 30}));
  EXPECT_FALSE(confirm_trial(folder_.path())) << "it does not run yet";
  ASSERT_TRUE(take_trial(folder_.path()));
  const auto written = confirm_trial(folder_.path());
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_THAT(*written, testing::ElementsAre(site));
  EXPECT_FALSE(confirm_trial(folder_.path())) << "nothing waits any more";
  EXPECT_EQ(finish_confirmed(folder_.path()).value(), std::nullopt);
  EXPECT_FALSE(end_trial(folder_.path()));
}

TEST_F(TrialFile, IsNotWrittenOverAChangeThatSomebodyMadeMeanwhile) {
  const fs::path site = folder_ / "site.toml", rig = folder_ / "rig.toml";
  std::ofstream(site) << "old";
  std::ofstream(rig) << "old rig";
  const FileTexts texts{{site, "new"}, {rig, "old rig"}};
  ASSERT_TRUE(request_trial(folder_.path(), {site, texts, 30, checksums_of(texts)}));
  ASSERT_TRUE(take_trial(folder_.path()));
  std::ofstream(rig) << "by hand";
  const auto refused = confirm_trial(folder_.path());
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("rig.toml was changed by "));
  EXPECT_THAT(refused.error().message, testing::ContainsRegex("at 20[0-9-]+T[0-9:]+Z since"));
  EXPECT_TRUE(running_trial(folder_.path()).value()) << "it runs on, and goes back";
  EXPECT_EQ(version_of(site).checksum, checksums_of(texts).at(site));
  std::ofstream(rig) << "old rig";
  EXPECT_TRUE(confirm_trial(folder_.path())) << "the change was taken back";
}

TEST_F(TrialFile, ThatCannotBeWrittenMayBeConfirmedAgain) {
  const fs::path site = folder_ / "sites/site.toml";
  std::ofstream(folder_ / "sites") << "in the way";
  ASSERT_TRUE(request_trial(folder_.path(), {site, {{site, "new"}}, 30}));
  ASSERT_TRUE(take_trial(folder_.path()));
  EXPECT_THAT(confirm_trial(folder_.path()).error().message, HasSubstr("cannot be made"));
  EXPECT_TRUE(confirmed_trial(folder_.path()).value());
  fs::remove(folder_ / "sites");
  EXPECT_TRUE(confirm_trial(folder_.path()));
  EXPECT_TRUE(fs::exists(site));
}

TEST_F(TrialFile, MakesTheFoldersOfNewFilesLikeTheOneAbove) {
  fs::permissions(folder_.path(), fs::perms(0775));
  const fs::path site = folder_ / "site.toml", recipe = folder_ / "recipes/new/one.toml";
  ASSERT_TRUE(request_trial(folder_.path(), {site, {{site, "new"}, {recipe, "one"}}, 30}));
  ASSERT_TRUE(take_trial(folder_.path()));
  const auto written = confirm_trial(folder_.path());
  ASSERT_TRUE(written) << written.error().message;
  EXPECT_TRUE(fs::exists(recipe));
  EXPECT_EQ(fs::status(recipe.parent_path()).permissions(), fs::perms(0775));
}

TEST_F(TrialFile, ThatIsNoUtf8IsRefused) {
  const auto requested = request_trial(folder_.path(), {"/etc/site.toml", {{"/a", "\xFF"}}, 30});
  EXPECT_THAT(requested.error().message, HasSubstr("is not UTF-8"));
  EXPECT_FALSE(is_trial_requested(folder_.path()));
}

/// Opening a pipe without a writer would block.
TEST_F(TrialFile, IsNoPipeAndNoFolder) {
  ASSERT_EQ(::mkfifo(requested_.c_str(), 0600), 0);
  EXPECT_THAT(take_trial(folder_.path()).error().message, HasSubstr("cannot be read: is a pipe"));
  end_trial(folder_.path());
  fs::create_directory(requested_);
  EXPECT_THAT(take_trial(folder_.path()).error().message, HasSubstr("Is a directory"));
}

}  // namespace
}  // namespace orbwatch::app::files
