// SPDX-License-Identifier: Apache-2.0
#include "hal/regular_file.h"

#include <gmock/gmock.h>
#include <sys/stat.h>
#include <unistd.h>

#include <fstream>
#include <string>

#include "tests/support/temporary_folder.h"

namespace orbwatch::hal {
namespace {

using testing::EndsWith;
using testing::StartsWith;

constexpr std::size_t kMost = std::size_t{20} << 10;

class RegularFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& text) const {
    std::ofstream(folder / "file", std::ios::binary) << text;
    return folder / "file";
  }
  static void expect_refused(const std::filesystem::path& file, const std::string& reason) {
    const auto text = read_regular_file(file, kMost);
    ASSERT_FALSE(text) << file;
    EXPECT_EQ(text.error().message, file.string() + ": cannot be read: " + reason);
  }

  const tests::TemporaryFolder folder;
};

TEST_F(RegularFile, IsReadWhole) {
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{16384}, kMost}) {
    std::string text(size, 'x');
    if (size > 0) text.front() = '\0';
    EXPECT_EQ(read_regular_file(write(text), kMost).value(), text) << size;
  }
}

/// The kernel states a size of 0 for its files.
TEST_F(RegularFile, IsReadWithoutAStatedSize) {
  EXPECT_THAT(read_regular_file("/proc/self/status", kMost).value(), StartsWith("Name:"));
}

TEST_F(RegularFile, ThatIsTooLargeIsRefused) {
  expect_refused(write(std::string(kMost + 1, 'x')), "is larger than 20 KiB");
}

TEST_F(RegularFile, ThatIsNotThereIsRefused) {
  expect_refused(folder / "absent", "No such file or directory");
}

TEST_F(RegularFile, IsNoFolder) { expect_refused(folder.path(), "Is a directory"); }

TEST_F(RegularFile, IsNoPipeWhichIsNotWaitedFor) {
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  expect_refused(folder / "pipe", "is a pipe or a device, not a regular file");
}

TEST_F(RegularFile, IsNoDeviceWithoutAnEnd) {
  expect_refused("/dev/zero", "is a pipe or a device, not a regular file");
}

TEST_F(RegularFile, ThatMayNotBeReadIsRefused) {
  const auto file = write("secret");
  ASSERT_EQ(::chmod(file.c_str(), 0), 0);
  if (::geteuid() != 0) return expect_refused(file, "Permission denied");
  constexpr uid_t kNobody = 65534;
  ASSERT_EQ(::chmod(folder.path().c_str(), 0755), 0);
  ASSERT_EQ(::seteuid(kNobody), 0);
  const auto text = read_regular_file(file, kMost);
  ASSERT_EQ(::seteuid(0), 0);
  ASSERT_FALSE(text);
  EXPECT_THAT(text.error().message, EndsWith("cannot be read: Permission denied"));
}

}  // namespace
}  // namespace orbwatch::hal
