// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/placement.h"

#include <gmock/gmock.h>

#include <exception>

#include "app/cli/archive/tar.h"
#include "app/cli/backup/service_stop.h"
#include "app/state/state_folder.h"
#include "tests/app/cli/backup/site.h"
#include "tests/support/service_user.h"

namespace orbwatch::app::cli::backup {
namespace {

using testing::HasSubstr;

/// Stops like a power cut.
struct PowerCut : std::exception {};

/// A disk on which one change fails: by an error, or by a power cut before or after it.
class FailingDisk : public DiskChanges {
 public:
  enum class Way { Error, Before, After };

  FailingDisk(int at, Way way) : at_(at), way_(way) {}

  Result<> write(const std::filesystem::path& file, std::string_view bytes, mode_t mode) override {
    return change([&] { return DiskChanges::write(file, bytes, mode); });
  }
  Result<> remove(const std::filesystem::path& path) override {
    return change([&] { return DiskChanges::remove(path); });
  }
  Result<> make_folder(const std::filesystem::path& folder) override {
    return change([&] { return DiskChanges::make_folder(folder); });
  }

  bool has_failed() const { return count_ > at_; }

 private:
  template <class Change>
  Result<> change(const Change& make) {
    if (count_++ != at_) return make();
    if (way_ == Way::Error) return fail("the disk fails");
    if (way_ == Way::After) {
      EXPECT_TRUE(make());
    }
    throw PowerCut();
  }

  int at_;
  Way way_;
  int count_ = 0;
};

/// A disk that refuses to write in one folder.
class ClosedFolderDisk : public DiskChanges {
 public:
  explicit ClosedFolderDisk(std::filesystem::path folder) : folder_(std::move(folder)) {}

  Result<> write(const std::filesystem::path& file, std::string_view bytes, mode_t mode) override {
    if (file.parent_path() == folder_) return fail("the folder is closed");
    return DiskChanges::write(file, bytes, mode);
  }

 private:
  std::filesystem::path folder_;
};

class Placement : public testing::Test {
 protected:
  Placement() {
    write_file(old.places.configuration / "site.toml", "old site");
    write_file(old.places.configuration / "rig.toml", "old rig", 0664);
    write_file(old.places.configuration / "recipes/kept.toml", "not in the backup");
    write_file(old.places.state / "users.json", "old users", 0600);
    write_file(old.places.state / "commands", "of the device");
    write_file(old.places.state / "logins.json", "of a user", 0600);
    write_file(old.places.configuration / "gone/old.toml", "not needed any more");
    before = old.states();
  }

  void give_all_to_service() const {
    tests::give_to_service(old.folder.path());
    for (const auto& entry : std::filesystem::recursive_directory_iterator(old.folder.path())) {
      tests::give_to_service(entry.path());
    }
  }
  /// Makes a folder of the configuration one of an administrator: `sudo mkdir`.
  void close(const std::string& name) const {
    const auto folder = old.places.configuration / name;
    ASSERT_EQ(::chown(folder.c_str(), 0, tests::kService), 0);
    ASSERT_EQ(::chmod(folder.c_str(), 02755), 0);
  }

  FileStates expected() const {
    FileStates states = before;
    for (const ArchivedFile& file : files) {
      const auto path = old.places.at(file.name).lexically_relative(old.folder.path());
      states[path.string()] = {file.bytes, file.mode};
    }
    states.erase("lib/logins.json");
    states.erase("etc/gone/old.toml");
    return states;
  }

  Device old;
  FileStates before;
  const Archive files{{"configuration/site.toml", "new site", 0644},
                      {"configuration/rig.toml", "new rig", 0640},
                      {"configuration/deep/er/lens.yaml", "new lens", 0644},
                      {"configuration/keys/key.pem", "new key", 0600},
                      {"state/users.json", "new users", 0600},
                      {"state/calibration.toml", "new alignment", 0600}};
  const std::vector<std::string> removed{"state/logins.json", "configuration/gone/old.toml",
                                         "configuration/none.toml"};
};

TEST_F(Placement, AllFilesAreReplacedAndOthersStay) {
  DiskChanges disk;
  const auto replaced = replace_files(old.places, files, disk, removed);
  ASSERT_TRUE(replaced) << replaced.error().message;
  EXPECT_EQ(old.states(), expected());
  EXPECT_FALSE(std::filesystem::exists(old.places.configuration / "gone"));
}

TEST_F(Placement, AnErrorAtAnyChangeLeavesTheOldFiles) {
  for (int at = 0;; ++at) {
    FailingDisk disk(at, FailingDisk::Way::Error);
    const auto replaced = replace_files(old.places, files, disk, removed);
    if (!disk.has_failed()) {
      EXPECT_GE(at, 9) << "the undo file, folders, files";
      EXPECT_TRUE(replaced);
      break;
    }
    ASSERT_FALSE(replaced) << at;
    EXPECT_EQ(replaced.error().message, "the disk fails; nothing was changed") << at;
    EXPECT_EQ(old.states(), before) << at;
  }
}

TEST_F(Placement, APowerCutAtAnyChangeLeavesTheOldOrTheNewFiles) {
  for (const auto way : {FailingDisk::Way::Before, FailingDisk::Way::After}) {
    int news = 0;
    for (int at = 0;; ++at) {
      Device device;
      for (const auto& [name, state] : before) {
        write_file(device.folder / name, state.first, state.second);
      }
      FailingDisk disk(at, way);
      try {
        EXPECT_TRUE(replace_files(device.places, files, disk, removed));
        EXPECT_EQ(device.states(), expected());
        break;
      } catch (const PowerCut&) {  // the next start puts it right, unless it is interrupted again
      }
      for (int again = 0;; ++again) {
        FailingDisk second(again, way);
        try {
          const auto undone = undo_unfinished(device.places, second);
          ASSERT_TRUE(undone) << undone.error().message;
          break;
        } catch (const PowerCut&) {
        }
      }
      const FileStates after = device.states();
      EXPECT_TRUE(after == before || after == expected()) << at;
      news += after == expected() ? 1 : 0;
      DiskChanges whole;
      EXPECT_EQ(undo_unfinished(device.places, whole).value_or(true), false);
    }
    EXPECT_EQ(news, way == FailingDisk::Way::After ? 1 : 0) << "after the removal of the undo file";
  }
}

TEST_F(Placement, WhenThePuttingBackFailsItIsSaidAndMayBeRepeated) {
  class DeadDisk : public DiskChanges {
   public:
    Result<> write(const std::filesystem::path& file, std::string_view bytes,
                   mode_t mode) override {
      if (++writes > 3) return fail("the disk is dead");
      return DiskChanges::write(file, bytes, mode);
    }
    int writes = 0;
  } disk;
  const auto replaced = replace_files(old.places, files, disk, removed);
  ASSERT_FALSE(replaced);
  EXPECT_THAT(replaced.error().message, HasSubstr("orbwatch restore --undo"));
  DiskChanges mended;
  EXPECT_EQ(undo_unfinished(old.places, mended).value_or(false), true);
  EXPECT_EQ(old.states(), before);
}

TEST_F(Placement, AFileThatIsRightIsNotWritten) {
  write_file(old.places.configuration / "keys/key.pem", "new key", 0600);
  before = old.states();
  ClosedFolderDisk disk(old.places.configuration / "keys");
  const auto replaced = replace_files(old.places, files, disk, removed);
  ASSERT_TRUE(replaced) << replaced.error().message;
  EXPECT_EQ(old.states(), expected());
}

TEST_F(Placement, AFileThatNeverChangedIsNotPutBack) {
  for (const mode_t mode : {0600U, 0640U}) {
    write_file(old.places.configuration / "keys/key.pem", mode == 0600U ? "old key" : "new key",
               mode);
    before = old.states();
    ClosedFolderDisk disk(old.places.configuration / "keys");
    const auto replaced = replace_files(old.places, files, disk, removed);
    ASSERT_FALSE(replaced);
    EXPECT_EQ(replaced.error().message, "the folder is closed; nothing was changed");
    EXPECT_EQ(old.states(), before);
  }
}

TEST_F(Placement, AFolderThatTheServiceMayNotWriteIsNamedFirst) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  write_file(old.places.configuration / "keys/key.pem", "old key", 0644);
  before = old.states();
  give_all_to_service();
  const auto is_refused = [&](const std::string& folder) {
    return tests::as_service(0027, [&] {
      DiskChanges disk;
      const auto checked = check_replaceable(old.places, files, removed);
      const auto replaced = replace_files(old.places, files, disk, removed);
      return !checked && !replaced && checked.error().message == replaced.error().message &&
             checked.error().message.starts_with((old.places.configuration / folder).string() +
                                                 ": its files cannot be replaced (Permission");
    });
  };
  close("keys");
  EXPECT_TRUE(is_refused("keys"));
  tests::give_to_service(old.places.configuration / "keys");
  close("gone");
  EXPECT_TRUE(is_refused("gone")) << "of a file that is to be removed";
  tests::give_to_service(old.places.configuration / "gone");
  std::filesystem::create_directory(old.places.configuration / "deep");
  close("deep");
  EXPECT_TRUE(is_refused("deep")) << "in which a folder is to be made";
  EXPECT_EQ(old.states(), before);
}

TEST_F(Placement, AnEmptyFolderThatTheServiceMayNotRemoveStays) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  const std::string name = "configuration/closed/open/old.toml";
  write_file(old.places.at(name), "not needed any more");
  give_all_to_service();
  close("closed");
  EXPECT_TRUE(tests::as_service(0027, [&] {
    DiskChanges disk;
    return replace_files(old.places, files, disk, {name}).has_value();
  }));
  EXPECT_TRUE(std::filesystem::is_empty(old.places.configuration / "closed/open"));
}

TEST_F(Placement, AKeyThatRootRestoresIsReadByTheService) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  std::filesystem::permissions(old.folder.path(), std::filesystem::perms(0755));
  ASSERT_EQ(::chown(old.places.configuration.c_str(), 0, tests::kService), 0);
  ASSERT_EQ(::chmod(old.places.configuration.c_str(), 02775), 0);
  tests::give_to_service(old.places.state);
  DiskChanges disk;
  ASSERT_TRUE(replace_files(old.places, files, disk, removed));
  const auto key = old.places.configuration / "keys/key.pem";
  const auto is_read = [&] {
    std::ifstream in(key);
    return std::string(std::istreambuf_iterator<char>(in), {}) == "new key";
  };
  EXPECT_TRUE(tests::as_service(0027, is_read));
  EXPECT_FALSE(tests::as_user(tests::kMember, 0027, is_read));
  EXPECT_EQ(old.states(), expected()) << "its mode stays";
  ASSERT_EQ(::chown(key.c_str(), 0, tests::kService), 0);
  ASSERT_TRUE(replace_files(old.places, files, disk, removed));
  EXPECT_TRUE(tests::as_service(0027, is_read)) << "when its bytes are right already, too";
  struct stat about {};
  ASSERT_EQ(::stat((old.places.configuration / "rig.toml").c_str(), &about), 0);
  EXPECT_EQ(about.st_uid, 0U) << "the group may read it";
}

TEST_F(Placement, ARunningDaemonIsNamedByItsUnit) {
  const auto running = reserve(old.places.state);
  ASSERT_TRUE(running);
  for (const auto& [config, unit] : std::map<std::string, std::string>{
           {"/etc/orbwatch/site.toml", "orbwatch"},
           {"/etc/orbwatch/press/site.toml", "orbwatch@press"},
           {"/etc/orbwatch/press/../lathe/site.toml", "orbwatch@lathe"},
           {"/etc/orbwatch/press/other.toml", "orbwatch"}}) {
    const auto excluded = exclude_daemon(config, old.places);
    ASSERT_FALSE(excluded);
    EXPECT_EQ(excluded.error().message, "orbwatchd runs; stop it first: systemctl stop " + unit);
  }
}

TEST_F(Placement, LinksAreNotFollowed) {
  const tests::TemporaryFolder elsewhere;
  write_file(elsewhere / "users.json", "of another");
  std::filesystem::remove(old.places.state / "users.json");
  std::filesystem::create_symlink(elsewhere / "users.json", old.places.state / "users.json");
  DiskChanges disk;
  auto replaced = replace_files(old.places, files, disk, removed);
  ASSERT_FALSE(replaced);
  EXPECT_THAT(replaced.error().message, HasSubstr("users.json: is a link"));
  std::filesystem::remove(old.places.state / "users.json");
  std::filesystem::create_directory_symlink(elsewhere.path(), old.places.configuration / "keys");
  replaced = replace_files(old.places, files, disk, removed);
  ASSERT_FALSE(replaced);
  EXPECT_THAT(replaced.error().message, HasSubstr("keys: is not a folder"));
  EXPECT_EQ(elsewhere.files(), 1);
}

TEST_F(Placement, AForgedUndoFileReachesNoOtherFile) {
  const auto tar = tar_of({{"absent", "state/commands\n"}, {"configuration/a", "x"}}, {});
  ASSERT_TRUE(tar);
  write_file(undo_file(old.places), *tar, 0600);
  DiskChanges disk;
  const auto undone = undo_unfinished(old.places, disk);
  ASSERT_FALSE(undone);
  EXPECT_THAT(undone.error().message, HasSubstr("state/commands: is not a file of a site"));
  EXPECT_TRUE(std::filesystem::exists(old.places.state / "commands"));
}

}  // namespace
}  // namespace orbwatch::app::cli::backup
