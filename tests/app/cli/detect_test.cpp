// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "proc/optics/lens.h"
#include "proc/optics/outline.h"
#include "tests/app/cli/command_line.h"
#include "tests/app/cli/documented_json.h"
#include "tests/proc/align/detect/painted_ball.h"

/// Runs `orbwatch detect` like a user.
namespace orbwatch::tests {
namespace {

using align::kPaintedLimb;

class Detect : public CommandLine {
 protected:
  nlohmann::json detected(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "detect");
    arguments.push_back("--json");
    EXPECT_EQ(run(arguments), 0) << said;
    return nlohmann::json::parse(said);
  }
  std::string picture() {
    return write("ball.png", align::painted_ball(align::kPaintedSize, kPaintedLimb));
  }
};

TEST_F(Detect, SaysWhereTheBallIs) {
  const auto ball = detected({picture()});
  EXPECT_EQ(ball["picture"]["width"], 400);
  EXPECT_NEAR(ball["outline"]["centre"][0].get<double>(), kPaintedLimb.centre.u, 1.2);
  EXPECT_NEAR(ball["outline"]["centre"][1].get<double>(), kPaintedLimb.centre.v, 1.2);
  EXPECT_NEAR(ball["outline"]["radii"][0].get<double>(), kPaintedLimb.rx, 1.2);
  EXPECT_EQ(ball["confident"], ball["confidence"].get<double>() >= 0.5);
  EXPECT_EQ(ball["confident"], ball["reason"].get<std::string>().empty());
  EXPECT_FALSE(ball.contains("ball"));
}

TEST_F(Detect, ItsTextGoesIntoARigFile) {
  ASSERT_EQ(run({"detect", picture()}), 0) << said;
  const std::size_t begin = said.find("width = ");
  ASSERT_NE(begin, std::string::npos) << said;
  write("rig.toml", "[[camera]]\nname = \"A\"\n" + said.substr(begin) + "distance = 12\n");
  EXPECT_EQ(run({"describe", "camera", "--rig", path("rig.toml"), "--camera", "A"}), 0) << said;
  EXPECT_NE(said.find("distance         12 ball radii"), std::string::npos) << said;
}

TEST_F(Detect, WithACalibrationItKnowsThePlace) {
  write("camera.yaml",
        "image_width: 400\nimage_height: 320\ncamera_name: a\ndistortion_model: plumb_bob\n"
        "camera_matrix: {rows: 3, cols: 3, data: [900, 0, 199.5, 0, 900, 159.5, 0, 0, 1]}\n"
        "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n");
  const auto ball = detected({picture(), "--calibration", path("camera.yaml")});
  const auto lens = optics::Lens::make({400, 320, 900, 900, 199.5, 159.5});
  ASSERT_TRUE(lens);
  const auto sight = optics::sight_from_outline(kPaintedLimb, *lens);
  ASSERT_TRUE(sight);
  ASSERT_EQ(run({"detect", "--help"}), 0);
  expect_documented(ball, said);
  EXPECT_NEAR(ball["ball"]["distance"].get<double>(), sight->distance, 0.1);
  EXPECT_NEAR(ball["ball"]["centre"][2].get<double>(), sight->axis.z * sight->distance, 0.1);
  EXPECT_NEAR(ball["ball"]["alpha"].get<double>(),
              360 - 2 * optics::degrees(std::asin(1 / sight->distance)), 0.2);
}

TEST_F(Detect, DrawsTheOutlineIntoThePicture) {
  const std::string file = picture();
  const auto ball = detected({file, "--overlay", path("seen.png")});
  const cv::Mat before = cv::imread(file), after = cv::imread(path("seen.png"));
  ASSERT_EQ(after.size(), before.size());
  const auto green_at = [&](double u, double v) {
    const auto pixel = after.at<cv::Vec3b>(cvRound(v), cvRound(u));
    return pixel[1] - std::max(pixel[0], pixel[2]);
  };
  const double u = ball["outline"]["centre"][0], v = ball["outline"]["centre"][1];
  EXPECT_GT(green_at(u, v), 50);
  EXPECT_GT(green_at(u - kPaintedLimb.rx, v), 50);
  EXPECT_GT(green_at(u, v + kPaintedLimb.ry), 50);
  cv::Mat change;
  cv::absdiff(before, after, change);
  EXPECT_LT(cv::mean(change)[0], 10) << "the picture itself is still there";
}

TEST_F(Detect, RefusesMistakesWithTheReason) {
  picture();
  write("black.png", cv::Mat(200, 300, CV_8U, cv::Scalar(0)));
  write("other.yaml",
        "image_width: 640\nimage_height: 480\ncamera_name: a\ndistortion_model: plumb_bob\n"
        "camera_matrix: {rows: 3, cols: 3, data: [900, 0, 320, 0, 900, 240, 0, 0, 1]}\n"
        "distortion_coefficients: {rows: 1, cols: 5, data: [0, 0, 0, 0, 0]}\n");
  for (const Mistake& mistake : {
           Mistake{"no picture", {}, {"one picture", "--help"}},
           Mistake{"two pictures", {"DIR/ball.png", "DIR/black.png"}, {"one picture"}},
           Mistake{"a file that is not there", {"DIR/none.png"}, {"none.png", "No such file"}},
           Mistake{"nothing to see", {"DIR/black.png"}, {"black.png", "no edges"}},
           Mistake{"an unknown kind", {"DIR/ball.png", "--overlay", "DIR/a.bmp"}, {".png"}},
           Mistake{"another camera's lens",
                   {"DIR/ball.png", "--calibration", "DIR/other.yaml"},
                   {"other.yaml", "640x480", "400x320"}},
       }) {
    SCOPED_TRACE(mistake.name);
    expect_refused("detect", mistake);
  }
}

}  // namespace
}  // namespace orbwatch::tests
