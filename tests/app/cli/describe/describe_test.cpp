// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/app/cli/command_line.h"
#include "tests/app/cli/documented_json.h"
#include "tests/app/cli/painted_machine.h"

/// Runs `orbwatch describe` like a user.
namespace orbwatch::tests {
namespace {

class Describe : public CommandLine {
 protected:
  static inline const PaintedCamera kFront{"front", 0}, kSide{"side", -60};

  Describe() {
    write("rig.toml", painted_ball() + kFront.calibrated() + kSide.calibrated() +
                          "[[camera]]\nname = \"plain\"\nwidth = 300\nheight = 300\n"
                          "[camera.outline]\ncentre = [149.5, 149.5]\nradius = 140\n"
                          "distance = 12\n");
  }

  std::string described(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "describe");
    EXPECT_EQ(run(arguments), 0) << said;
    return said;
  }
  cv::FileStorage json(std::vector<std::string> arguments) {
    arguments.push_back("--json");
    return {described(std::move(arguments)),
            cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_JSON};
  }
  std::vector<std::string> of_view(std::vector<std::string> more,
                                   const std::vector<std::string>& cameras = {"front"}) {
    more.insert(more.begin(), {"view", "--rig", path("rig.toml")});
    for (const std::string& name : cameras) more.insert(more.end(), {"--camera", name});
    return more;
  }
  void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
    for (const std::string& part : parts) {
      EXPECT_NE(text.find(part), std::string::npos) << text << "lacks: " << part;
    }
  }
};

/// Pixels per degree at the point where the ball reflects the camera itself: there the reflected
/// ray turns by 2 d - 1 times the turn of the camera's ray.
double best_resolution() {
  return PaintedCamera::focal_length() / (2 * PaintedCamera::kDistance - 1) * std::numbers::pi /
         180;
}

TEST_F(Describe, TheViewsResolutionIsThatOfTheBall) {
  const cv::FileStorage towards = json(of_view({"--h-fov", "60", "--size", "101x101"}));
  EXPECT_EQ(static_cast<std::string>(towards["view"]["kind"]), "perspective");
  EXPECT_NEAR(static_cast<double>(towards["view"]["h_fov"]), 60, 1e-5);
  EXPECT_NEAR(static_cast<double>(towards["view"]["v_fov"]), 60, 1e-5);
  const cv::FileNode camera = towards["cameras"][0];
  EXPECT_EQ(static_cast<std::string>(camera["name"]), "front");
  EXPECT_NEAR(static_cast<double>(camera["pixels_per_degree"]["max"]), best_resolution(), 1e-4);
  EXPECT_EQ(static_cast<double>(camera["seen"]), 1);
  const cv::FileNode r = camera["pixels_per_degree"];
  EXPECT_LT(static_cast<double>(r["min"]), static_cast<double>(r["median"]));
  EXPECT_LT(static_cast<double>(r["median"]), static_cast<double>(r["max"]));
}

TEST_F(Describe, SharesOfTheViewAreCounted) {
  const cv::FileStorage sphere = json(of_view({"--view", "equirectangular", "--size", "360x180"}));
  EXPECT_NEAR(static_cast<double>(sphere["view"]["h_fov"]), 360, 1e-3);
  EXPECT_NEAR(static_cast<double>(sphere["view"]["v_fov"]), 180, 1e-3);
  const double cone = std::asin(1 / PaintedCamera::kDistance);
  int blind = 0;
  for (int y = 0; y < 180; ++y) {
    for (int x = 0; x < 360; ++x) {
      const double lon = (x + 0.5 - 180) * std::numbers::pi / 180;
      const double lat = (90 - y - 0.5) * std::numbers::pi / 180;
      blind += -std::cos(lat) * std::cos(lon) > std::cos(cone);
    }
  }
  const cv::FileNode camera = sphere["cameras"][0];
  EXPECT_NEAR(static_cast<double>(camera["blind"]), blind / (360.0 * 180), 1e-6);
  EXPECT_NEAR(static_cast<double>(camera["seen"]), 1 - blind / (360.0 * 180), 1e-6);
  EXPECT_EQ(static_cast<double>(camera["outside"]), 0);
}

TEST_F(Describe, ResolutionIsWrittenAsPicture) {
  const cv::FileStorage said_of = json(of_view(
      {"--view", "equirectangular", "--size", "180x90", "-o", path("map.png")}, {"front", "side"}));
  EXPECT_EQ(said_of["cameras"].size(), 2U);
  const cv::Mat map = cv::imread(path("map.png"), cv::IMREAD_UNCHANGED);
  ASSERT_EQ(map.type(), CV_16UC1);
  ASSERT_EQ(map.size(), cv::Size(180, 90));
  EXPECT_NEAR(map.at<std::uint16_t>(45, 90), 100 * best_resolution(), 1) << "towards the front one";
  EXPECT_NEAR(map.at<std::uint16_t>(45, 60), 100 * best_resolution(), 1) << "towards the side one";
  EXPECT_GT(map.at<std::uint16_t>(45, 0), 0) << "one fills the other's blind cone";
  EXPECT_LT(map.at<std::uint16_t>(45, 150), 80 * best_resolution());
}

TEST_F(Describe, ABallWithoutARigNeedsThePicturesSize) {
  const std::string text =
      described({"view", "--ball", "149.5,149.5,140", "--distance", "12", "--size-of-picture",
                 "300x300", "--yaw", "180", "--h-fov", "4", "--size", "32x32"});
  expect_parts(text, {"perspective, 32x32", "| - | - | - | 0.0 % | 100.0 % | 0.0 % |"});
}

TEST_F(Describe, ACameraIsToldInText) {
  const std::string text = described({"camera", "--rig", path("rig.toml"), "--camera", "side"});
  expect_parts(text, {"side", "300x300", "exact", "yaw -60", "12 ball radii, 600 mm", "350.4396",
                      "149.5, 149.5 px, axes 140, 140"});
  expect_parts(described({"camera", "--rig", path("rig.toml"), "--camera", "plain"}),
               {"plain", "12 ball radii", "350.4396"});
}

TEST_F(Describe, ACameraIsToldToPrograms) {
  const auto side =
      parsed(described({"camera", "--rig", path("rig.toml"), "--camera", "side", "--json"}));
  EXPECT_EQ(side["camera"], "side");
  EXPECT_EQ(side["picture"]["width"], 300);
  EXPECT_NEAR(side["facing"]["yaw"].get<double>(), -60, 1e-9);
  EXPECT_NEAR(side["distance_mm"].get<double>(), 600, 1e-6);
  EXPECT_NEAR(side["alpha"].get<double>(), 350.4396, 1e-4);
  const optics::Vec3 at = PaintedCamera::kCentre + PaintedCamera{"side", -60}.facing() * 600;
  EXPECT_NEAR(side["position"][0].get<double>(), at.x, 1e-6);
  EXPECT_NEAR(side["position"][1].get<double>(), at.y, 1e-6);
  EXPECT_NEAR(side["outline"]["radii"][0].get<double>(), 140, 0.01);
  EXPECT_NEAR(side["lens"]["focal_lengths"][1].get<double>(), PaintedCamera::focal_length(), 1e-9);
  EXPECT_EQ(side["lens"]["distortion"], "none");
  EXPECT_TRUE(side["lens"]["coefficients"].empty());
  const auto plain =
      parsed(described({"camera", "--rig", path("rig.toml"), "--camera", "plain", "--json"}));
  EXPECT_TRUE(plain["lens"].is_null());
  expect_documented(side, described({"camera", "--help"}));
  EXPECT_EQ(run({"describe", "camera", "--rig", path("rig.toml"), "--camera", "side", "--json",
                 "--format", "ros"}),
            2);
}

TEST_F(Describe, WhatAViewResolvesIsDocumented) {
  const auto view = parsed(described(of_view({"--h-fov", "60", "--size", "32x32", "--json"})));
  expect_documented(view, described({"view", "--help"}));
}

TEST_F(Describe, ACamerasCalibrationIsWhatOpenCvReads) {
  const std::string yaml =
      described({"camera", "--rig", path("rig.toml"), "--camera", "front", "--format", "opencv"});
  const cv::FileStorage file(
      yaml, cv::FileStorage::READ | cv::FileStorage::MEMORY | cv::FileStorage::FORMAT_YAML);
  cv::Mat matrix;
  file["camera_matrix"] >> matrix;
  ASSERT_EQ(matrix.size(), cv::Size(3, 3));
  EXPECT_NEAR(matrix.at<double>(0, 0), PaintedCamera::focal_length(), 1e-9);
  EXPECT_NEAR(matrix.at<double>(0, 2), 149.5, 1e-12);
  expect_parts(
      described({"camera", "--rig", path("rig.toml"), "--camera", "front", "--format", "ros"}),
      {"camera_name: front", "image_width: 300", "distortion_model"});
}

TEST_F(Describe, PrintsTheManuals) {
  expect_parts(described({"rig"}), {"[[camera]]", "intrinsics"});
  expect_parts(described({"config"}), {"[[camera]]"});
  EXPECT_NE(described({"registers"}), described({"registers", "--format", "csv"}));
  expect_parts(described({"--help"}), {"config", "rig", "registers", "view", "camera"});
  for (const char* subject : {"registers", "camera"}) {
    expect_parts(described({subject, "--help"}), {"--format"});
  }
}

class DescribeMistake : public Describe, public testing::WithParamInterface<Mistake> {};

TEST_P(DescribeMistake, IsOneLineAndNoFile) { expect_refused("describe", GetParam()); }

INSTANTIATE_TEST_SUITE_P(
    All, DescribeMistake,
    testing::Values(
        Mistake{"Nothing", {}, {"config, rig, recipe, registers, http, view, camera"}},
        Mistake{"UnknownSubject", {"ball"}, {"config, rig, recipe, registers, http, view, camera"}},
        Mistake{"TooMuchForAManual", {"config", "view"}, {"unexpected", "view"}},
        Mistake{"ViewWithoutAnything", {"view"}, {"--ball", "--rig"}},
        Mistake{"ViewWithoutPictureSize",
                {"view", "--ball", "50,50,40", "--alpha", "350"},
                {"--size-of-picture"}},
        Mistake{"BallOutsideOfThePicture",
                {"view", "--ball", "500,50,40", "--alpha", "350", "--size-of-picture", "100x80"},
                {"100x80"}},
        Mistake{"ViewWithAPicture",
                {"view", "--rig", "DIR/rig.toml", "--camera", "front=a.png"},
                {"--camera", "no picture"}},
        Mistake{"MapAsJpeg",
                {"view", "--rig", "DIR/rig.toml", "--camera", "front", "-o", "DIR/map.jpg"},
                {"map.jpg", "8 bit"}},
        Mistake{"MapInNoFolder",
                {"view", "--rig", "DIR/rig.toml", "--camera", "front", "--size", "32x32", "-o",
                 "DIR/no/map.png"},
                {"no/map.png"}},
        Mistake{"NoFov",
                {"view", "--rig", "DIR/rig.toml", "--camera", "front", "--h-fov", "0"},
                {"h_fov"}},
        Mistake{"CameraWithoutRig", {"camera", "--camera", "front"}, {"--rig"}},
        Mistake{"CameraWithoutName", {"camera", "--rig", "DIR/rig.toml"}, {"--camera"}},
        Mistake{"UnknownCamera",
                {"camera", "--rig", "DIR/rig.toml", "--camera", "top"},
                {"rig.toml", "top", "front, side, plain"}},
        Mistake{"NoCalibration",
                {"camera", "--rig", "DIR/rig.toml", "--camera", "plain", "--format", "ros"},
                {"plain", "intrinsics"}},
        Mistake{"UnknownFormat",
                {"camera", "--rig", "DIR/rig.toml", "--camera", "plain", "--format", "xml"},
                {"text, opencv, ros"}}),
    [](const auto& mistake) { return mistake.param.name; });

}  // namespace
}  // namespace orbwatch::tests
