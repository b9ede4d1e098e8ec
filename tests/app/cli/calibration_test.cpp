// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "app/files/runtime/calibration_file.h"
#include "tests/app/cli/command_line.h"
#include "tests/app/cli/documented_json.h"
#include "tests/app/files/machine_files.h"

/// Runs `orbwatch calibration` like a user.
namespace orbwatch::tests {
namespace {

class Calibration : public CommandLine {
 protected:
  void SetUp() override {
    write("rig.toml", app::files::kRig);
    write("site.toml", "state_folder = \"state\"\n" + app::files::kValid);
    std::filesystem::create_directory(path("state"));
    std::vector<app::CalibrationEntry> entries;
    for (const double radius : {31.0, 32.0}) {
      app::CalibrationEntry entry;
      entry.method = "detect";
      entry.quality = "confidence 0.9";
      entry.rig = app::files::rig_checksum(path("rig.toml")).value_or(0);
      entry.alignment.cameras.push_back(
          {.camera = "a", .outline = optics::Outline{{50, 40}, radius, radius, 0}});
      app::files::accept(entries, entry);
    }
    ASSERT_TRUE(
        app::files::save_calibrations(app::files::calibration_file(path("state")), entries));
  }

  int run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "calibration");
    arguments.insert(arguments.end(), {"--config", path("site.toml")});
    return CommandLine::run(arguments);
  }

  double radius() {
    const auto site = app::files::resolve(path("site.toml"));
    EXPECT_TRUE(site) << site.error().message;
    return site ? site->rig.cameras[0].outline->rx : 0;
  }
};

TEST_F(Calibration, ShowsWhatCountsNow) {
  ASSERT_EQ(run({"history"}), 0) << said;
  const std::size_t first = said.find("earlier"), second = said.find("in force");
  ASSERT_NE(first, std::string::npos) << said;
  EXPECT_LT(first, second) << said;
}

TEST_F(Calibration, TellsProgramsTheSame) {
  ASSERT_EQ(run({"history", "--json"}), 0) << said;
  const auto json = parsed(said);
  ASSERT_EQ(json["alignments"].size(), 2U) << said;
  EXPECT_EQ(json["alignments"][0]["state"], "earlier");
  EXPECT_EQ(json["alignments"][1]["number"], 2);
  EXPECT_EQ(json["alignments"][1]["camera"], "a");
  EXPECT_EQ(json["alignments"][1]["state"], "in force");
  EXPECT_EQ(json["alignments"][1]["method"], "detect");
  ASSERT_EQ(run({"--help"}), 0);
  expect_documented(json, said);
  EXPECT_EQ(run({"restore", "1", "--json"}), 2);
  EXPECT_EQ(radius(), 32) << "nothing was restored";
}

TEST_F(Calibration, RestoresAnEarlierOneAndGoesBackToTheRig) {
  EXPECT_EQ(radius(), 32);
  ASSERT_EQ(run({"restore", "1"}), 0) << said;
  EXPECT_EQ(radius(), 31);
  ASSERT_EQ(run({"reset", "a"}), 0) << said;
  EXPECT_EQ(radius(), 30);
  ASSERT_EQ(run({"history"}), 0) << said;
  EXPECT_NE(said.find("reset to the rig file"), std::string::npos) << said;
  EXPECT_NE(said.find("restored 1: detect"), std::string::npos) << said;
}

TEST_F(Calibration, RefusesWhatItDoesNotHave) {
  EXPECT_EQ(run({"restore", "7"}), 1);
  EXPECT_NE(said.find("there is no alignment 7"), std::string::npos) << said;
  EXPECT_EQ(run({"reset", "spare"}), 1);
  EXPECT_EQ(run({"forget"}), 2);
  write("rig.toml", app::files::kRig + "# changed\n");
  EXPECT_EQ(run({"restore", "1"}), 1);
  EXPECT_NE(said.find("another rig file"), std::string::npos) << said;
}

}  // namespace
}  // namespace orbwatch::tests
