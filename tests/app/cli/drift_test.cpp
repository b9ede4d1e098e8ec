// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/app/cli/command_line.h"
#include "tests/app/cli/documented_json.h"
#include "tests/app/cli/recorded_pictures.h"
#include "tests/support/picture_of_mat.h"

/// Runs `orbwatch drift` like a user.
namespace orbwatch::tests {
namespace {

constexpr const char* kRig =
    "[[camera]]\nname = \"A\"\nwidth = 320\nheight = 240\n"
    "[camera.outline]\ncentre = [160, 120]\nradii = [90, 90]\ndistance = 12\n";

class DriftCommand : public CommandLine {
 protected:
  /// Blotched disc on a blotched ground, moved together.
  static cv::Mat ball(double u, double v) {
    cv::Mat blots(80, 100, CV_32F), other(30, 40, CV_32F), ground, seen;
    cv::RNG(5).fill(blots, cv::RNG::UNIFORM, 30, 200);
    cv::RNG(6).fill(other, cv::RNG::UNIFORM, 30, 200);
    cv::resize(blots, seen, {400, 320}, 0, 0, cv::INTER_CUBIC);
    cv::resize(other, ground, {400, 320}, 0, 0, cv::INTER_CUBIC);
    cv::Mat mask(seen.size(), CV_8U, cv::Scalar(255)), out;
    cv::circle(mask, {200, 160}, 90, cv::Scalar(0), cv::FILLED);
    ground.copyTo(seen, mask);
    const cv::Matx23d map(1, 0, 40 - u, 0, 1, 40 - v);
    cv::warpAffine(seen, out, map, {320, 240}, cv::INTER_LINEAR | cv::WARP_INVERSE_MAP);
    out.convertTo(out, CV_8U);
    return out;
  }

  /// Writes a folder with pictures; those from `jump` on are moved.
  std::string sequence(const std::string& name, int jump, double u, double v, int pictures = 12) {
    std::filesystem::create_directory(path(name));
    for (int n = 0; n < pictures; ++n) {
      write(name + "/f" + std::to_string(n) + ".png", n < jump ? ball(0, 0) : ball(u, v));
    }
    return path(name);
  }

  /// At 3 pictures per second it lasts longer than the learning of the zero.
  std::string standing() { return sequence("standing", 20, 0, 0, 20); }

  nlohmann::json drift(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"drift", "--rig", write("rig.toml", kRig)});
    arguments.push_back("--json");
    EXPECT_EQ(run(arguments), 0) << said;
    return nlohmann::json::parse(said);
  }
};

TEST_F(DriftCommand, SaysGoodOfAStandingCamera) {
  const auto state = drift({"A=" + standing(), "--rate", "3"});
  EXPECT_EQ(state["state"], "good");
  EXPECT_EQ(state["reason"], "");
  EXPECT_EQ(state["frames"], 20);
  EXPECT_EQ(state["measured"], 8) << "12 pictures were the zero's";
  EXPECT_TRUE(state["first_warning_frame"].is_null());
  EXPECT_TRUE(state["first_alarm_frame"].is_null());
  EXPECT_LT(state["direction_error_deg"].get<double>(), 0.05);
}

TEST_F(DriftCommand, MeasuresNothingInASequenceThatEndsBeforeTheZeroIsLearnt) {
  const std::string standing = this->standing();
  const auto state = drift({"A=" + standing});  // at 30 pictures per second
  EXPECT_EQ(state["state"], "not measured");
  EXPECT_EQ(state["reason"], "the zero of the drift is being learnt");
  EXPECT_EQ(state["measured"], 0);
  EXPECT_EQ(state["not_measured"]["the zero of the drift is being learnt"], 16);
  EXPECT_EQ(state["direction_error_deg"], 0);
  EXPECT_EQ(state["outline"]["centre"], nlohmann::json({160.0, 120.0}));
  ASSERT_EQ(run({"drift", "--rig", path("rig.toml"), "A=" + standing}), 0) << said;
  EXPECT_NE(said.find("not measured: the zero of the drift is being learnt"), std::string::npos)
      << said;
  EXPECT_EQ(said.find("deg rms"), std::string::npos) << said;
}

TEST_F(DriftCommand, NamesThePictureOfAJumpAndTheCorrectedOutline) {
  const auto state = drift({"A=" + sequence("bumped", 10, 9, -5)});
  EXPECT_EQ(state["state"], "alarm");
  EXPECT_EQ(state["first_alarm_frame"], 10) << "f10.png comes after f9.png";
  EXPECT_NEAR(state["shift"]["u"].get<double>(), 9, 0.1);
  EXPECT_NEAR(state["shift"]["v"].get<double>(), -5, 0.1);
  EXPECT_NEAR(state["shift_percent"]["centre"].get<double>(), 100 * std::hypot(9, 5) / 90, 0.2);
  EXPECT_NEAR(state["outline"]["centre"][0].get<double>(), 169, 0.1);
  EXPECT_NEAR(state["outline"]["radii"][0].get<double>(), 90, 0.1);
  EXPECT_GT(state["direction_error_deg"].get<double>(), 10);
  ASSERT_EQ(run({"drift", "--help"}), 0);
  auto documented = state;
  documented["not_measured"].clear();  // its keys are reasons
  expect_documented(documented, said);
}

TEST_F(DriftCommand, WatchesARecordedEventLikeAFolder) {
  const auto of_folder = drift({"A=" + sequence("bumped", 10, 9, -5)});
  std::vector<cv::Mat> pictures;
  std::vector<RecordedPictureOf> recorded;
  for (std::uint64_t n = 0; n < 12; ++n) {
    pictures.push_back(n < 10 ? ball(0, 0) : ball(9, -5));
    recorded.push_back({"A", n, picture_of_mat(pictures.back())});
  }
  write_recorded_pictures(path("event.mcap"), recorded);
  EXPECT_EQ(drift({"A=" + path("event.mcap")}), of_folder);
  ASSERT_EQ(run({"drift", "--rig", path("rig.toml"), "A=" + path("event.mcap")}), 0) << said;
  EXPECT_NE(said.find("picture 11, picture 10"), std::string::npos) << said;
}

TEST_F(DriftCommand, ComparesWithAReferenceAndOtherLimits) {
  const std::string reference = write("reference.png", ball(0, 0));
  const std::string moved = sequence("moved", 0, 0.5, 0);
  const auto state = drift({"A=" + moved, "--reference", reference});
  EXPECT_EQ(state["state"], "alarm");
  EXPECT_NEAR(state["shift"]["u"].get<double>(), 0.5, 0.05);
  const auto lenient =
      drift({"A=" + moved, "--reference", reference, "--warning", "2", "--alarm", "3"});
  EXPECT_EQ(lenient["state"], "good");
}

TEST_F(DriftCommand, ItsTextNamesPictureAndReason) {
  const std::string rig = write("rig.toml", kRig), bumped = sequence("bumped", 10, 9, -5);
  ASSERT_EQ(run({"drift", "--rig", rig, "A=" + bumped}), 0) << said;
  EXPECT_NE(said.find("picture 11, f10.png"), std::string::npos) << said;
  EXPECT_NE(said.find("4 not: the first pictures"), std::string::npos) << said;
  EXPECT_NE(said.find("[camera.outline]"), std::string::npos) << said;
}

TEST_F(DriftCommand, RefusesMistakesWithTheReason) {
  write("rig.toml", kRig);
  sequence("still", 12, 0, 0);
  std::filesystem::create_directory(path("empty"));
  std::filesystem::create_directory(path("other"));
  write("other/a.png", cv::Mat(50, 60, CV_8U, cv::Scalar(90)));
  write("black.png", cv::Mat(240, 320, CV_8U, cv::Scalar(0)));
  const auto with = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"--rig", "DIR/rig.toml"});
    return arguments;
  };
  for (const Mistake& mistake : {
           Mistake{"no camera", with({}), {"CAMERA=PATH", "--help"}},
           Mistake{"no folder", with({"A"}), {"CAMERA=PATH"}},
           Mistake{"no rig", {"A=x"}, {"--rig"}},
           Mistake{"an unknown camera", with({"B=x"}), {"no camera B", "A"}},
           Mistake{"no such folder", with({"A=/nowhere"}), {"/nowhere"}},
           Mistake{"limits", with({"A=x", "--warning", "2"}), {"limits"}},
           Mistake{"a rate", with({"A=x", "--rate", "0"}), {"--rate"}},
       }) {
    SCOPED_TRACE(mistake.name);
    expect_refused("drift", mistake);
  }
  for (const Mistake& mistake : {
           Mistake{"no pictures", with({"A=" + path("empty")}), {"empty", "no pictures in it"}},
           Mistake{"no recording", with({"A=" + write("a.mcap", "text")}), {"a.mcap", "MCAP"}},
           Mistake{"another size", with({"A=" + path("other")}), {"a.png", "60x50", "320x240"}},
           Mistake{"a black reference",
                   with({"A=" + path("still"), "--reference", "DIR/black.png"}),
                   {"black.png", "dark"}},
       }) {
    SCOPED_TRACE(mistake.name);
    expect_refused("drift", mistake);
  }
}

}  // namespace
}  // namespace orbwatch::tests
