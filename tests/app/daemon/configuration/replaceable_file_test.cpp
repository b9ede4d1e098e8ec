// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/configuration/replaceable_file.h"

#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/temporary_folder.h"

/// Texts from clients, and the files that they would replace.
namespace orbwatch::app::daemon {
namespace {

using testing::HasSubstr;
namespace fs = std::filesystem;

class ReplaceableFile : public testing::Test {
 protected:
  ReplaceableFile() {
    fs::create_directories(folder / "state");
    write("site.toml");
    write("rig.toml");
  }

  fs::path write(const std::string& name, fs::perms mode = fs::perms(0640)) const {
    const fs::path file = folder / name;
    std::ofstream(file) << "content\n";
    fs::permissions(file, mode);
    return file;
  }
  /// Returns the refusal; empty: the file may be replaced.
  std::string refusal(const fs::path& file, const std::vector<fs::path>& state) const {
    const auto allowed = check_replaceable(file, folder / "site.toml",
                                           {folder / "site.toml", folder / "rig.toml"}, state);
    return allowed ? "" : allowed.error().message;
  }
  std::string refusal(const std::string& name) const {
    return refusal(folder / name, {folder / "state"});
  }

  tests::TemporaryFolder folder;
};

TEST_F(ReplaceableFile, IsOneThatTheConfigurationNames) {
  EXPECT_EQ(refusal("site.toml"), "");
  EXPECT_EQ(refusal("rig.toml"), "");
}

TEST_F(ReplaceableFile, IsNoOtherOneThatIsThere) {
  for (const char* name : {"key.pem", "other.toml", "users.json"}) {
    write(name);
    EXPECT_THAT(refusal(name), HasSubstr("does not name it")) << name;
  }
}

TEST_F(ReplaceableFile, IsNewWithTheEndingOfAConfiguration) {
  for (const char* name : {"lens.yaml", "lens.yml", "recipes/two.toml"}) {
    EXPECT_EQ(refusal(name), "") << name;
  }
  for (const char* name : {"users.json", "key.pem", "first-code", "lens.yaml.part", ".toml"}) {
    EXPECT_THAT(refusal(name), HasSubstr("must end with .toml, .yaml or .yml")) << name;
  }
}

TEST_F(ReplaceableFile, IsNotPrivate) {
  write("rig.toml", fs::perms(0600));
  EXPECT_THAT(refusal("rig.toml"), HasSubstr("mode 0640 or 0644"));
}

TEST_F(ReplaceableFile, IsNotInTheFolderOfTheState) {
  EXPECT_THAT(refusal("state/lens.yaml"), HasSubstr("the appliance's state"));
  EXPECT_THAT(refusal("state/keys/lens.yaml"), HasSubstr("the appliance's state"));
  EXPECT_EQ(refusal("state-of-old/lens.yaml"), "");
}

TEST_F(ReplaceableFile, IsFoundInTheFolderOfTheStateThroughALink) {
  fs::create_directory_symlink(folder / "state", folder / "link");
  EXPECT_THAT(refusal("link/lens.yaml"), HasSubstr("the appliance's state"));
}

TEST_F(ReplaceableFile, MayBeWhereConfigurationAndStateShareAFolder) {
  write("users.json");
  EXPECT_EQ(refusal(folder / "rig.toml", {folder.path()}), "");
  EXPECT_EQ(refusal(folder / "lens.yaml", {folder.path()}), "");
  EXPECT_THAT(refusal(folder / "users.json", {folder.path()}), HasSubstr("does not name it"));
}

}  // namespace
}  // namespace orbwatch::app::daemon
