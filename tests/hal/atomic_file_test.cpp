#include "hal/atomic_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "hal/thread/file_descriptor.h"
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
