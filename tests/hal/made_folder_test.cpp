// SPDX-License-Identifier: Apache-2.0
#include "hal/made_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "tests/support/service_user.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::hal {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

struct stat about(const fs::path& path) {
  struct stat read {};
  EXPECT_EQ(::stat(path.c_str(), &read), 0) << path;
  return read;
}

TEST(MadeFolder, HasTheModeOfTheOneAboveWhateverTheUmask) {
  const orbwatch::tests::TemporaryFolder folder;
  const mode_t mask = ::umask(077);
  for (const mode_t mode : {0700U, 0755U, 0775U}) {
    const fs::path above = folder.path() / std::to_string(mode), file = above / "a/b/file";
    fs::create_directory(above);
    ASSERT_EQ(::chmod(above.c_str(), mode), 0);
    const auto made = make_folders_above(file);
    EXPECT_TRUE(made) << made.error().message;
    EXPECT_EQ(about(file.parent_path()).st_mode & 07777U, mode);
    EXPECT_TRUE(make_folders_above(file)) << "they are there";
  }
  EXPECT_EQ(::umask(mask), 077U) << "the umask of the process stays";
}

TEST(MadeFolder, BelongsToTheOwnerOfTheOneAbove) {
  ORBWATCH_WITHOUT_ROOT_SKIPPED();
  const orbwatch::tests::TemporaryFolder folder;
  const fs::path above = folder.path() / "of-service";
  fs::create_directory(above);
  orbwatch::tests::give_to_service(above);
  ASSERT_EQ(::chmod(above.c_str(), 02770), 0);
  ASSERT_TRUE(make_folder(above / "new"));
  EXPECT_EQ(about(above / "new").st_uid, orbwatch::tests::kService);
  EXPECT_EQ(about(above / "new").st_gid, orbwatch::tests::kService);
  EXPECT_EQ(about(above / "new").st_mode & 07777U, 02770U);
}

TEST(MadeFolder, IsRefusedWhereSomethingElseIs) {
  const orbwatch::tests::TemporaryFolder folder;
  std::ofstream(folder / "file") << "x";
  EXPECT_THAT(make_folder(folder.path() / "file").error().message, HasSubstr("File exists"));
  EXPECT_THAT(make_folders_above(folder.path() / "file/below").error().message,
              HasSubstr("cannot be made"));
}

}  // namespace
}  // namespace orbwatch::hal
