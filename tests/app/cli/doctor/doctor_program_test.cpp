// SPDX-License-Identifier: Apache-2.0
#include <nlohmann/json.hpp>
#include <utility>

#include "tests/app/cli/command_line.h"
#include "tests/app/cli/documented_json.h"

/// Runs `orbwatch doctor` like an installer, on the machine of the test.
namespace orbwatch::tests {
namespace {

class Doctor : public CommandLine {
 protected:
  /// Path of the shipped demo, which needs no device, no port and no network.
  std::string demo() {
    const auto shipped = std::filesystem::path(ORBWATCH_SOURCE_DIR) / "platform/config";
    for (const char* name : {"demo-rig.toml", "demo-recipe.toml"}) {
      std::filesystem::copy_file(shipped / name, path(name));
    }
    std::ifstream in(shipped / "demo.toml");
    std::string text{std::istreambuf_iterator<char>(in), {}};
    for (const auto& [part, instead] : std::vector<std::pair<std::string, std::string>>{
             {"port = 1502", "port = 0"}, {"[web]\n", "[web]\nport = 0\n"}}) {
      const std::size_t at = text.find(part);
      EXPECT_NE(at, std::string::npos) << part;
      text.replace(at, part.size(), instead);
    }
    return write("site.toml", "state_folder = \"" + path("state") + "\"\n" + text);
  }

  void expect_levels(const std::string& worst) {
    const auto report = nlohmann::json::parse(said.substr(0, said.rfind('}') + 1), nullptr, false);
    const std::string printed = said;
    ASSERT_EQ(run({"doctor", "--help"}), 0);
    const std::string help = std::exchange(said, printed);
    ASSERT_TRUE(report.is_object()) << said;
    expect_documented(report, help);
    EXPECT_TRUE(worst.empty() || report["worst"] == worst) << said;
    for (const auto& check : report["checks"]) {
      const bool is_ok = check["level"] == "ok";
      ASSERT_TRUE(check["remedy"].is_string()) << check;
      EXPECT_EQ(check["remedy"].get<std::string>().empty(), is_ok) << check;
    }
  }
};

TEST_F(Doctor, FindsNoFaultWhereTheConfigurationNeedsNothing) {
  const std::string site = demo();
  EXPECT_EQ(run({"doctor", "--config", site, "--json"}), 0) << said;
  expect_levels("");
  EXPECT_EQ(run({"doctor", "--config", site}), 0) << said;
  EXPECT_NE(said.find("0 faults"), std::string::npos) << said;
  EXPECT_NE(said.find("configuration"), std::string::npos) << said;
}

TEST_F(Doctor, AFaultIsStatus1AndStillATableOrJson) {
  const std::string none = path("none.toml");
  EXPECT_EQ(run({"doctor", "--config", none}), 1);
  EXPECT_NE(said.find("none.toml: there is none. Remedy: orbwatch setup"), std::string::npos);
  EXPECT_NE(said.find("orbwatch: 1 fault"), std::string::npos) << said;
  EXPECT_EQ(run({"doctor", "--config", none, "--json"}), 1);
  expect_levels("fault");
}

TEST_F(Doctor, ACameraThatIsNotThereIsAFault) {
  const auto shipped = std::filesystem::path(ORBWATCH_SOURCE_DIR) / "platform/config";
  for (const char* name : {"usb-camera.toml", "usb-camera-rig.toml", "usb-camera-recipe.toml"}) {
    std::filesystem::copy_file(shipped / name, path(name));
  }
  EXPECT_EQ(run({"doctor", "--config", path("usb-camera.toml")}), 1) << said;
  EXPECT_NE(said.find("fault    cameras"), std::string::npos) << said;
}

TEST_F(Doctor, WrongUsageIsStatus2) {
  EXPECT_EQ(run({"doctor", "--yaml"}), 2);
  EXPECT_EQ(run({"doctor", "site.toml"}), 2);
  EXPECT_EQ(run({"doctor", "--config"}), 2);
  expect_refused("doctor", {"Option", {"--yaml"}, {"--yaml", "--help"}});
  EXPECT_EQ(run({"doctor", "--help"}), 0);
  EXPECT_NE(said.find("Exit status 1: there is a fault."), std::string::npos);
}

}  // namespace
}  // namespace orbwatch::tests
