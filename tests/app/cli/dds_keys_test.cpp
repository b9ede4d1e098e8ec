// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "tests/app/cli/command_line.h"

/// Runs `orbwatch dds-keys` like a user.
namespace orbwatch::tests {
namespace {

using testing::HasSubstr;

class DdsKeys : public CommandLine {};

TEST_F(DdsKeys, NamesTheFoldersThatItMade) {
  EXPECT_EQ(run({"dds-keys", path("keys"), "--domain", "7", "--prefix", "cell/orbwatch"}), 0)
      << said;
  EXPECT_EQ(said, path("keys/enclaves/appliance") + "\n" + path("keys/enclaves/subscriber") + "\n");
  const auto permissions = [this](const std::string& name) {
    std::ifstream in(path("keys/enclaves/" + name + "/permissions.xml"));
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  EXPECT_THAT(permissions("appliance"), HasSubstr("rt/cell/orbwatch/command<"));
  EXPECT_THAT(permissions("appliance"), HasSubstr("<min>7</min>"));

  const std::vector<std::string> same{"--domain", "7", "--prefix", "cell/orbwatch"};
  const auto add = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"dds-keys", path("keys")});
    arguments.insert(arguments.end(), same.begin(), same.end());
    return run(arguments);
  };
  EXPECT_EQ(add({"--subscriber", "office", "--read-only"}), 0) << said;
  EXPECT_EQ(said, path("keys/enclaves/office") + "\n");
  EXPECT_EQ(permissions("office").find("/command<"), std::string::npos);
  EXPECT_NE(permissions("subscriber").find("/command<"), std::string::npos);

  EXPECT_EQ(add({}), 1);
  EXPECT_THAT(said, HasSubstr("holds keys already"));
  EXPECT_EQ(add({"--subscriber", "office"}), 1);
  EXPECT_THAT(said, HasSubstr("office: is there already; --replace"));
  EXPECT_EQ(add({"--subscriber", "office", "--replace"}), 0) << said;
  EXPECT_EQ(add({"--replace"}), 0) << said;
  EXPECT_FALSE(std::filesystem::exists(path("keys/enclaves/office"))) << "all new";
}

TEST_F(DdsKeys, RefusesWhatMakesNoSense) {
  const std::string keys = "DIR/keys";
  expect_refused("dds-keys", {"Folder", {}, {"say which FOLDER"}});
  expect_refused("dds-keys", {"Folders", {keys, "DIR/more"}, {"one only"}});
  expect_refused("dds-keys", {"Days", {keys, "--days", "0"}, {"--days must be 1 to 36500"}});
  expect_refused("dds-keys", {"Domain", {keys, "--domain", "231"}, {"--domain is 231"}});
  expect_refused("dds-keys", {"Prefix", {keys, "--prefix", "a-b"}, {"prefix \"a-b\""}});
  expect_refused("dds-keys", {"Name", {keys, "--subscriber", "../a"}, {"\"../a\""}});
  expect_refused("dds-keys", {"Option", {keys, "--force"}, {"--force"}});
  expect_refused("dds-keys", {"Unwritable", {"/proc/keys"}, {"/proc/keys: cannot be made"}});
}

}  // namespace
}  // namespace orbwatch::tests
