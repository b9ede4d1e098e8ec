// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/staged_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <optional>

#include "tests/app/ports/recorder/export/recorded_event.h"

namespace orbwatch::app::recorder {
namespace {

using testing::HasSubstr;

class Staged : public testing::Test {
 protected:
  static void write(const std::filesystem::path& file, const char* text) {
    std::ofstream(file) << text;
  }

  const tests::TemporaryFolder folder_;
  const std::filesystem::path target_ = folder_ / "a.csv";
};

TEST_F(Staged, IsThereWhenItIsPlaced) {
  auto staged = StagedFile::beside(target_, Existing::Kept);
  ASSERT_TRUE(staged);
  write(staged->path(), "new");
  EXPECT_FALSE(std::filesystem::exists(target_));
  const auto placed = staged->place();
  ASSERT_TRUE(placed) << placed.error().message;
  EXPECT_EQ(tests::text_in(target_), "new");
  EXPECT_EQ(folder_.files(), 1);
}

TEST_F(Staged, LeavesNothingUnlessItIsPlaced) {
  {
    const auto staged = StagedFile::beside(target_, Existing::Kept);
    ASSERT_TRUE(staged);
    write(staged->path(), "half");
    EXPECT_EQ(folder_.files(), 1);
  }
  EXPECT_EQ(folder_.files(), 0);
}

TEST_F(Staged, AnExistingFileIsKept) {
  write(target_, "old");
  const auto refused = StagedFile::beside(target_, Existing::Kept);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("--force"));
  EXPECT_EQ(tests::text_in(target_), "old");
}

TEST_F(Staged, AFileThatAppearsMeanwhileIsKept) {
  std::optional staged = StagedFile::beside(target_, Existing::Kept);
  ASSERT_TRUE(*staged);
  write((*staged)->path(), "new");
  write(target_, "old");
  EXPECT_FALSE((*staged)->place());
  EXPECT_EQ(tests::text_in(target_), "old");
  staged.reset();
  EXPECT_EQ(folder_.files(), 1);
}

TEST_F(Staged, ReplacesAFileAndNothingElse) {
  write(target_, "old");
  auto staged = StagedFile::beside(target_, Existing::Replaced);
  ASSERT_TRUE(staged);
  write(staged->path(), "new");
  ASSERT_TRUE(staged->place());
  EXPECT_EQ(tests::text_in(target_), "new");
  EXPECT_FALSE(StagedFile::beside(folder_.path(), Existing::Replaced)) << "a folder";
  std::filesystem::create_symlink("a.csv", folder_ / "link");
  EXPECT_FALSE(StagedFile::beside(folder_ / "link", Existing::Replaced));
}

TEST_F(Staged, AMissingFolderIsAnErrorAtThePlace) {
  auto staged = StagedFile::beside(folder_ / "missing/a.csv", Existing::Kept);
  ASSERT_TRUE(staged);
  EXPECT_FALSE(staged->place());
}

}  // namespace
}  // namespace orbwatch::app::recorder
