// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/app/cli/command_line.h"
#include "tests/app/cli/painted_machine.h"

/// Runs `orbwatch project` with a rig: cameras that are selected by name and merged.
namespace orbwatch::tests {
namespace {

constexpr int kWidth = 256, kHeight = 128;

class ProjectRig : public CommandLine {
 protected:
  static inline const PaintedCamera kFront{"front", 0}, kBack{"back", 180}, kSide{"side", 75};

  ProjectRig() {
    write("rig.toml", painted_ball() + kFront.calibrated() + kBack.calibrated() +
                          kSide.calibrated() +
                          "[[camera]]\nname = \"plain\"\nwidth = 300\nheight = 300\n"
                          "[camera.outline]\ncentre = [149.5, 149.5]\nradius = 140\n"
                          "distance = 12\n");
    write("front.png", kFront.picture());
    write("back.png", kBack.picture());
    write("side.png", kSide.picture());
  }

  cv::Mat projected(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "project");
    arguments.insert(arguments.end(), {"--rig", path("rig.toml"), "-o", path("out.png")});
    EXPECT_EQ(run(arguments), 0) << said;
    return cv::imread(path("out.png"), cv::IMREAD_UNCHANGED);
  }
  /// Projects the whole sphere as BGRA.
  cv::Mat panorama(const std::vector<std::string>& cameras, std::vector<std::string> more = {}) {
    for (const std::string& name : cameras) {
      more.insert(more.end(), {"--camera", name + "=" + path(name + ".png")});
    }
    more.insert(more.end(),
                {"--view", "equirectangular", "--size", "256x128", "--undefined", "transparent"});
    return projected(more);
  }

  /// Largest difference from the room's own light, levels of sRGB.
  static int worst(const cv::Mat& panorama) {
    int worst = 0;
    for (int y = 0; y < kHeight; ++y) {
      for (int x = 0; x < kWidth; ++x) {
        const double lon = ((x + 0.5) / kWidth - 0.5) * 2 * std::numbers::pi;
        const double lat = (0.5 - (y + 0.5) / kHeight) * std::numbers::pi;
        const cv::Vec3d light = room_light(
            {std::cos(lat) * std::sin(lon), std::cos(lat) * std::cos(lon), std::sin(lat)});
        const auto& pixel = panorama.at<cv::Vec4b>(y, x);
        for (int k = 0; k < 3; ++k) {
          worst = std::max(worst, std::abs(pixel[k] - srgb(light[2 - k])));
        }
      }
    }
    return worst;
  }
  static int holes(const cv::Mat& panorama) {
    cv::Mat alpha;
    cv::extractChannel(panorama, alpha, 3);
    return kWidth * kHeight - cv::countNonZero(alpha);
  }
};

TEST_F(ProjectRig, OppositeCamerasShowTheWholeSphereAsItIs) {
  EXPECT_GT(holes(panorama({"front"})), 20);
  const cv::Mat both = panorama({"front", "back"});
  EXPECT_EQ(holes(both), 0);
  EXPECT_LE(worst(both), 3);
  EXPECT_EQ(said, "");
}

TEST_F(ProjectRig, DifferentExposureAndWhiteBalanceAreMatched) {
  write("back.png", kBack.picture({2.2, 1.8, 1.4}));
  const cv::Mat matched = panorama({"front", "back"});
  EXPECT_EQ(holes(matched), 0);
  EXPECT_LE(worst(matched), 5);
  EXPECT_EQ(said, "");
  EXPECT_GT(worst(panorama({"front", "back"}, {"--match", "none"})), 30);
}

TEST_F(ProjectRig, ThreeCamerasAreMatchedToTheFirst) {
  write("front.png", kFront.picture({0.8, 0.8, 0.8}));
  write("side.png", kSide.picture({1.5, 1.2, 0.9}));
  EXPECT_LE(worst(panorama({"back", "front", "side"})), 5);
}

TEST_F(ProjectRig, ASayOfCamerasThatShareNothingIsGiven) {
  // Both cameras cover the same part of the sphere, but one picture is black.
  write("back.png", cv::Mat(300, 300, CV_8UC3, cv::Scalar::all(0)));
  const cv::Mat out = panorama({"front", "back"});
  EXPECT_NE(said.find("back"), std::string::npos) << said;
  EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
  EXPECT_EQ(holes(out), 0);
}

TEST_F(ProjectRig, DeepGreyCountsStayCountsAndAreMatched) {
  const auto counts = [this](const PaintedCamera& camera, double gain) {
    cv::Mat grey, deep;
    cv::cvtColor(camera.picture(), grey, cv::COLOR_BGR2GRAY);
    grey.convertTo(deep, CV_16U, 40 / gain);
    write(camera.name + ".png", deep);
  };
  counts(kFront, 1);
  counts(kBack, 1);
  std::vector<std::string> arguments{"--camera", "front=" + path("front.png"),
                                     "--camera", "back=" + path("back.png"),
                                     "--view",   "equirectangular",
                                     "--size",   "256x128"};
  const cv::Mat equal = projected(arguments);
  ASSERT_EQ(equal.type(), CV_16UC1);
  counts(kBack, 1.25);
  EXPECT_LE(cv::norm(projected(arguments), equal, cv::NORM_INF), 40 * 1.5) << "levels of 40 counts";
}

TEST_F(ProjectRig, OneCameraAndOnePictureNeedNoEqualsSign) {
  const std::vector<std::string> view{"--yaw", "20", "--size", "160x120"};
  std::vector<std::string> bare{path("front.png"), "--camera", "front"};
  std::vector<std::string> named{"--camera", "front=" + path("front.png")};
  bare.insert(bare.end(), view.begin(), view.end());
  named.insert(named.end(), view.begin(), view.end());
  EXPECT_EQ(cv::norm(projected(bare), projected(named), cv::NORM_INF), 0);
}

TEST_F(ProjectRig, AModelGivenByHandReplacesTheRigs) {
  const std::vector<std::string> view{"--yaw", "100", "--h-fov", "70", "--size", "160x120"};
  for (const char* model : {"exact", "paper", "classical"}) {
    std::vector<std::string> rig{path("front.png"), "--camera", "plain", "--model", model};
    rig.insert(rig.end(), view.begin(), view.end());
    const cv::Mat by_rig = projected(rig);
    std::vector<std::string> ball{
        "project", path("front.png"), "--ball", "149.5,149.5,140", "--model", model,
        "-o",      path("ball.png")};
    if (std::string(model) != "classical") ball.insert(ball.end(), {"--distance", "12"});
    ball.insert(ball.end(), view.begin(), view.end());
    ASSERT_EQ(run(ball), 0) << said;
    EXPECT_EQ(cv::norm(by_rig, cv::imread(path("ball.png")), cv::NORM_INF), 0) << model;
  }
}

TEST_F(ProjectRig, EveryKindOfViewIsDrawn) {
  for (const char* kind :
       {"perspective", "equirectangular", "cylindrical", "stereographic", "fisheye"}) {
    const cv::Mat out = projected({path("front.png"), "--camera", "front", "--view", kind,
                                   "--h-fov", "120", "--size", "101x101"});
    ASSERT_EQ(out.size(), cv::Size(101, 101)) << kind;
    const cv::Vec3d light = room_light({0, 1, 0});
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(out.at<cv::Vec3b>(50, 50)[k], srgb(light[2 - k]), 2) << kind << ", middle";
    }
  }
}

TEST_F(ProjectRig, ABallViewIsTheFirstCamerasOwnPictureOfIt) {
  const cv::Mat out =
      projected({"--camera", "front=" + path("front.png"), "--camera", "back=" + path("back.png"),
                 "--view", "ball", "--size", "201x201", "--undefined", "transparent"});
  ASSERT_EQ(out.type(), CV_8UC4);
  EXPECT_EQ(out.at<cv::Vec4b>(0, 0)[3], 0) << "beside the ball";
  // In the middle the ball reflects the camera itself; left and right are not mirrored.
  const cv::Mat in = kFront.picture();
  const auto at = [&](double share, const cv::Mat& picture, double radius) {
    const int middle = (picture.cols - 1) / 2;
    return middle + static_cast<int>(std::lround(share * radius));
  };
  // The limb is somewhere along the middle row: the first and last visible pixel.
  int left = 0, right = 200;
  while (out.at<cv::Vec4b>(100, left)[3] == 0) ++left;
  while (out.at<cv::Vec4b>(100, right)[3] == 0) --right;
  const double radius = (right - left) / 2.0;
  EXPECT_GT(radius, 80);
  for (const double share : {-0.7, -0.3, 0.0, 0.4, 0.8}) {
    const auto& mine = out.at<cv::Vec4b>(100, at(share, out, radius));
    const auto& theirs = in.at<cv::Vec3b>(149, at(share, in, PaintedCamera::kLimb));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(mine[k], theirs[k], 4) << share;
  }
}

TEST_F(ProjectRig, WritesTheCameraInfoOfAPerspectiveView) {
  projected({path("front.png"), "--camera", "front", "--size", "640x480", "--camera-info",
             path("info.yaml")});
  std::ifstream file(path("info.yaml"));
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  for (const char* part : {"image_width: 640", "image_height: 480", "319.5", "239.5", "320"}) {
    EXPECT_NE(text.find(part), std::string::npos) << text << "lacks: " << part;
  }
}

class ProjectRigMistake : public ProjectRig, public testing::WithParamInterface<Mistake> {};

TEST_P(ProjectRigMistake, IsOneLineAndNoFile) {
  write("small.png", cv::Mat(80, 100, CV_8UC3, cv::Scalar(1, 2, 3)));
  write("deep.png", cv::Mat(300, 300, CV_16UC3, cv::Scalar(1, 2, 3)));
  write("grey.png", cv::Mat(300, 300, CV_8UC1, cv::Scalar(1)));
  write("broken.toml", std::string("[ball\n"));
  expect_refused("project", GetParam());
}

std::vector<std::string> with_rig(std::vector<std::string> more) {
  more.insert(more.end(), {"--rig", "DIR/rig.toml", "-o", "DIR/o.png", "--size", "64x48"});
  return more;
}

INSTANTIATE_TEST_SUITE_P(
    All, ProjectRigMistake,
    testing::Values(
        Mistake{"RigAndBall",
                with_rig({"--camera", "front=DIR/front.png", "--ball", "150,150,140"}),
                {"--rig", "--ball"}},
        Mistake{"RigAndAlpha",
                with_rig({"--camera", "front=DIR/front.png", "--alpha", "350"}),
                {"--rig", "--alpha"}},
        Mistake{"RigAndDistance",
                with_rig({"--camera", "front=DIR/front.png", "--distance", "12"}),
                {"--rig", "--distance"}},
        Mistake{"RigAndRotation",
                with_rig({"--camera", "front=DIR/front.png", "--rotation", "0,0,0"}),
                {"--rig", "--rotation"}},
        Mistake{"CameraWithoutRig",
                {"DIR/front.png", "-o", "DIR/o.png", "--camera", "front"},
                {"--camera", "--rig"}},
        Mistake{"NoCamera", with_rig({"DIR/front.png"}), {"--camera"}},
        Mistake{"UnknownCamera",
                with_rig({"--camera", "top=DIR/front.png"}),
                {"rig.toml", "top", "front, back, side, plain"}},
        Mistake{"TheSameTwice",
                with_rig({"--camera", "front=DIR/front.png", "--camera", "front=DIR/back.png"}),
                {"front", "twice"}},
        Mistake{"FiveCameras",
                with_rig({"--camera", "a=x", "--camera", "b=x", "--camera", "c=x", "--camera",
                          "d=x", "--camera", "e=x"}),
                {"5", "at most 4"}},
        Mistake{"NoSuchRig",
                {"--rig", "DIR/none.toml", "--camera", "front=DIR/front.png", "-o", "DIR/o.png"},
                {"none.toml"}},
        Mistake{"BrokenRig",
                {"--rig", "DIR/broken.toml", "--camera", "front=DIR/front.png", "-o", "DIR/o.png"},
                {"broken.toml"}},
        Mistake{"NoPicture", with_rig({"--camera", "front"}), {"IN"}},
        Mistake{"OneOfTwoPictures",
                with_rig({"--camera", "front=DIR/front.png", "--camera", "back"}),
                {"back", "--camera back=IN"}},
        Mistake{"APictureOfNobody",
                with_rig({"DIR/side.png", "--camera", "front=DIR/front.png"}),
                {"side.png", "no camera"}},
        Mistake{"NoSuchPicture", with_rig({"--camera", "front=DIR/none.png"}), {"none.png"}},
        Mistake{
            "OtherSizeThanTheRigs",
            with_rig({"--camera", "front=DIR/small.png"}),
            {"small.png: the picture is 100x80 px, but camera front of the rig has 300x300 px"}},
        Mistake{"DifferentDepths",
                with_rig({"--camera", "front=DIR/front.png", "--camera", "back=DIR/deep.png"}),
                {"front.png", "deep.png", "16 bit", "8 bit"}},
        Mistake{"DifferentChannels",
                with_rig({"--camera", "front=DIR/front.png", "--camera", "back=DIR/grey.png"}),
                {"front.png", "grey.png", "grey", "colour"}},
        Mistake{"UnknownMatch",
                with_rig({"--camera", "front=DIR/front.png", "--match", "perfect"}),
                {"photometric, none"}},
        Mistake{"TurnedBallView",
                with_rig({"--camera", "front=DIR/front.png", "--view", "ball", "--yaw", "10"}),
                {"ball"}},
        Mistake{"CameraInfoOfAPanorama",
                with_rig({"--camera", "front=DIR/front.png", "--view", "equirectangular",
                          "--camera-info", "DIR/info.yaml"}),
                {"--camera-info", "perspective"}},
        Mistake{"CameraInfoInNoFolder",
                with_rig({"--camera", "front=DIR/front.png", "--camera-info", "DIR/no/info.yaml"}),
                {"no/info.yaml", "No such file"}}),
    [](const auto& mistake) { return mistake.param.name; });

}  // namespace
}  // namespace orbwatch::tests
