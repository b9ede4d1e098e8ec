// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/placement.h"

#include <gmock/gmock.h>

#include <exception>

#include "app/cli/archive/tar.h"
#include "tests/app/cli/backup/site.h"

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
