// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <sys/stat.h>

#include <cstdlib>

#include "app/cli/archive/tar.h"
#include "hal/regular_file.h"
#include "tests/app/cli/archive/frames.h"
#include "tests/app/cli/command_line.h"
#include "tests/app/files/machine_files.h"

/// Runs `orbwatch support` like an installer, on the machine of the test.
namespace orbwatch::tests {
namespace {

using testing::HasSubstr;

class Support : public CommandLine {
 protected:
  void SetUp() override {
    write("rig.toml", app::files::kRig);
    write("site.toml", "# winter-comment-4711\nstate_folder = \"state\"\n" + app::files::kValid +
                           "[dds]\nenabled = false\n");
  }
  app::cli::Archive unpacked() {
    const auto bytes = hal::read_regular_file(path("support.tar.zst"));
    EXPECT_TRUE(bytes) << said;
    const auto tar = app::cli::decompressed(bytes.value_or(""), std::size_t{256} << 20);
    EXPECT_TRUE(tar) << tar.error().message;
    const auto archive = app::cli::parse_tar(tar.value_or(""));
    EXPECT_TRUE(archive) << archive.error().message;
    return archive.value_or(app::cli::Archive{});
  }
};

TEST_F(Support, WritesOneFileForItsOwnerOnly) {
  ::setenv("WINTER_TOKEN", "winter-environment-4711", 1);
  write("support.tar.zst", "an older one");
  std::filesystem::permissions(path("support.tar.zst"), std::filesystem::perms(0644));
  const int status = run({"support", "-o", path("support.tar.zst"), "--config", path("site.toml")});
  ::unsetenv("WINTER_TOKEN");
  ASSERT_EQ(status, 0) << said;
  EXPECT_THAT(said, HasSubstr("pictures/: not asked for"));
  struct stat about {};
  ASSERT_EQ(::stat(path("support.tar.zst").c_str(), &about), 0);
  EXPECT_EQ(about.st_mode & 07777U, 0600U);
  std::string names;
  for (const auto& file : unpacked()) {
    names += file.name + " ";
    EXPECT_EQ(file.bytes.find("4711"), std::string::npos) << file.name;
  }
  for (const char* name : {"contents.txt", "doctor.json", "versions.txt", "configuration/site.toml",
                           "configuration/rig.toml"}) {
    EXPECT_THAT(names, HasSubstr(name));
  }
}

TEST_F(Support, WrongUsageIsStatus2AndAFolderThatIsMissingAnError) {
  EXPECT_EQ(run({"support"}), 2);
  EXPECT_THAT(said, HasSubstr("-o FILE is missing"));
  EXPECT_EQ(run({"support", "-o", path("none/file"), "--config", path("site.toml")}), 1);
  EXPECT_THAT(said, HasSubstr("none/file: cannot be written"));
}

}  // namespace
}  // namespace orbwatch::tests
