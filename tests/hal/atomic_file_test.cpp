// SPDX-License-Identifier: Apache-2.0
#include "hal/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <algorithm>
#include <fstream>
#include <iomanip>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include "hal/thread/file_descriptor.h"
#include "tests/support/service_user.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::hal {
namespace {

namespace fs = std::filesystem;

std::set<std::string> names(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) {
    names.insert(entry.path().filename().string());
  }
  return names;
}

std::string text(const fs::path& file) {
  std::ifstream in(file);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST(WriteFile, ReplacesAFileAndLeavesNoOther) {
  const tests::TemporaryFolder folder;
  const std::vector<std::uint8_t> first{'o', 'l', 'd', 'e', 'r'}, second{'n', 'e', 'w'};
  ASSERT_TRUE(write_file(folder.path() / "a.png", first));
  ASSERT_TRUE(write_file(folder.path() / "a.png", second));
  EXPECT_EQ(text(folder.path() / "a.png"), "new");
  EXPECT_EQ(names(folder.path()), std::set<std::string>{"a.png"});
}

TEST(WriteFile, KeepsTheModeOfTheFile) {
  const tests::TemporaryFolder folder;
  const fs::path file = folder.path() / "site.toml";
  ASSERT_TRUE(write_file(file, "old"));
  const auto mode = fs::perms(0604);
  fs::permissions(file, mode);
  ASSERT_TRUE(write_file(file, "new"));
  EXPECT_EQ(text(file), "new");
  EXPECT_EQ(fs::status(file).permissions(), mode);
}

/// Folder that root has made for a service.
class FileOfTheService : public testing::TestWithParam<mode_t> {
 protected:
  void SetUp() override {
    ORBWATCH_WITHOUT_ROOT_SKIPPED();
    make("etc", 0, 02775);
    make("state", tests::kService, 0750);
    fs::permissions(folder.path(), fs::perms(0755));
  }

  void make(const char* name, uid_t owner, mode_t mode) {
    fs::create_directory(folder / name);
    ASSERT_EQ(::chown((folder / name).c_str(), owner, tests::kService), 0);
    ASSERT_EQ(::chmod((folder / name).c_str(), mode), 0);
  }
  bool is_written(uid_t user, const fs::path& file, FileAccess access) const {
    return tests::as_user(user, GetParam(),
                          [&] { return write_file(file, "text", access).has_value(); });
  }
  static bool is_read(uid_t user, const fs::path& file) {
    return tests::as_user(user, 0, [&] { return text(file) == "text"; });
  }

  const tests::TemporaryFolder folder;
};

TEST_P(FileOfTheService, IsReadByItWhoeverWritesIt) {
  for (const uid_t user : {uid_t{0}, tests::kService, tests::kMember}) {
    const fs::path file = folder / "etc" / std::to_string(user);
    for (const char* what : {"new", "replaced"}) {
      ASSERT_TRUE(is_written(user, file, FileAccess::Folder)) << user;
      EXPECT_TRUE(is_read(tests::kService, file)) << what << " by " << user;
    }
  }
  const fs::path file = folder / "state/calibration.toml";
  for (const uid_t user : {uid_t{0}, tests::kService}) {
    for (const char* what : {"new", "replaced"}) {
      ASSERT_TRUE(is_written(user, file, FileAccess::Folder)) << user;
      EXPECT_TRUE(is_read(tests::kService, file)) << what << " by " << user;
      EXPECT_FALSE(is_read(tests::kStranger, file)) << what << " by " << user;
    }
    fs::remove(file);
  }
}

TEST_P(FileOfTheService, IsItsOwnAgainWhenRootReplacesIt) {
  const fs::path file = folder / "state/calibration.toml";
  ASSERT_TRUE(is_written(tests::kService, file, FileAccess::Folder));
  ASSERT_TRUE(is_written(0, file, FileAccess::Folder));
  struct stat about {};
  ASSERT_EQ(::stat(file.c_str(), &about), 0);
  EXPECT_EQ(about.st_uid, tests::kService);
  // Ownership that an earlier version left to root.
  ASSERT_EQ(::chown(file.c_str(), 0, 0), 0);
  ASSERT_TRUE(is_written(0, file, FileAccess::Folder));
  EXPECT_TRUE(is_read(tests::kService, file));
}

TEST_P(FileOfTheService, IsForItAloneWhereItMayHoldSecrets) {
  for (const uid_t user : {uid_t{0}, tests::kService}) {
    const fs::path file = folder / "state" / std::to_string(user);
    ASSERT_TRUE(is_written(user, file, FileAccess::Owner));
    fs::permissions(file, fs::perms(0644));  // mode that an earlier version left
    ASSERT_TRUE(is_written(user, file, FileAccess::Owner));
    EXPECT_TRUE(is_read(tests::kService, file)) << user;
    EXPECT_FALSE(is_read(tests::kMember, file)) << user;
  }
}

TEST_P(FileOfTheService, IsNeverWhatALinkLeadsTo) {
  const fs::path secret = folder / "secret";
  std::ofstream(secret) << "of root";
  fs::permissions(secret, fs::perms(0600));
  fs::create_symlink(secret, folder / "state/link");
  ASSERT_TRUE(is_written(0, folder / "state/link", FileAccess::Folder));
  EXPECT_TRUE(is_read(tests::kService, folder / "state/link"));
  EXPECT_EQ(text(secret), "of root");
}

INSTANTIATE_TEST_SUITE_P(Umask, FileOfTheService, testing::Values(0, 0022, 0027, 0077),
                         [](const auto& mask) {
                           std::ostringstream name;
                           name << std::oct << std::setw(3) << std::setfill('0') << mask.param;
                           return name.str();
                         });

TEST(RemoveUnfinished, RemovesWhatIsLeftAndNothingElse) {
  const tests::TemporaryFolder folder;
  const std::set<std::string> others{"a.png", "a.png.part", "notes.part", ".12-0.part"};
  for (const std::string& name : others) std::ofstream(folder.path() / name) << "mine";
  std::ofstream(folder.path() / "a.png.12-0.part") << "half";
  const fs::path written = folder.path() / "b.png.13-7.part";
  {
    const FileDescriptor writer(::open(written.c_str(), O_CREAT | O_WRONLY, 0600));
    ASSERT_EQ(::flock(writer.get(), LOCK_EX), 0);
    ASSERT_TRUE(remove_unfinished(folder.path()));
    EXPECT_TRUE(fs::exists(written)) << "it is being written";
  }
  ASSERT_TRUE(remove_unfinished(folder.path()));
  EXPECT_EQ(names(folder.path()), others);
}

TEST(RemoveUnfinished, SaysWhichFolderItCannotRead) {
  const auto removed = remove_unfinished("/nowhere");
  ASSERT_FALSE(removed);
  EXPECT_NE(removed.error().message.find("/nowhere"), std::string::npos);
}

}  // namespace
}  // namespace orbwatch::hal
