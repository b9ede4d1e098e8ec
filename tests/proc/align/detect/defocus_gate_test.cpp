// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <string>

#include "proc/align/detect/ball_detector.h"
#include "tests/proc/align/detect/any_room.h"
#include "tests/support/mirror_room.h"
#include "tests/support/picture_of_mat.h"
#include "tests/support/reference_data.h"
#include "tests/support/rendered_scene.h"
#include "tests/support/share.h"

/// Detection of a ball that is out of focus: what the camera blurs is light, not its 8-bit code.
namespace orbwatch::tests {
namespace {

using align::detect_ball;
using optics::Outline;

float light_of(float code) {
  return code <= 0.04045F ? code / 12.92F : std::pow((code + 0.055F) / 1.055F, 2.4F);
}

float code_of(float light) {
  return light <= 0.0031308F ? 12.92F * light : 1.055F * std::pow(light, 1 / 2.4F) - 0.055F;
}

template <class Function>
void change_each(cv::Mat& samples, const Function& function) {
  for (int v = 0; v < samples.rows; ++v) {
    float* const row = samples.ptr<float>(v);
    std::transform(row, row + samples.cols * samples.channels(), row, function);
  }
}

/// A uniform disc of a radius in pixels, by 8x8 samples to a pixel.
cv::Mat disc(double radius) {
  const int half = static_cast<int>(radius) + 1;
  cv::Mat kernel(2 * half + 1, 2 * half + 1, CV_32F);
  for (int v = -half; v <= half; ++v) {
    for (int u = -half; u <= half; ++u) {
      int covered = 0;
      for (int n = 0; n < 64; ++n) {
        covered += std::hypot(u + (n % 8 - 3.5) / 8, v + (n / 8 - 3.5) / 8) <= radius ? 1 : 0;
      }
      kernel.at<float>(v + half, u + half) = static_cast<float>(covered);
    }
  }
  return kernel / cv::sum(kernel)[0];
}

/// A picture in sRGB, or a linear one of 16 bit, blurred by a disc, with noise of one count.
cv::Mat defocused(const cv::Mat& picture, double radius) {
  const bool is_linear = picture.depth() == CV_16U;
  cv::Mat light;
  picture.convertTo(light, CV_32F, is_linear ? 1 : 1 / 255.0);
  if (!is_linear) change_each(light, light_of);
  cv::Mat blurred, noise(light.size(), light.type());
  cv::filter2D(light, blurred, -1, disc(radius));
  if (!is_linear) {
    change_each(blurred, code_of);
    blurred *= 255;
  }
  cv::RNG random(7);
  random.fill(noise, cv::RNG::NORMAL, 0, 1);
  blurred += noise;
  blurred.convertTo(blurred, picture.depth());
  return blurred;
}

/// The larger of the errors of centre and mean radius, pixels.
double outline_error(const Outline& found, const Outline& truth) {
  const double apart = std::hypot(found.centre.u - truth.centre.u, found.centre.v - truth.centre.v);
  return std::max(apart, std::abs(optics::mean_radius(found) - optics::mean_radius(truth)));
}

struct Trial {
  bool is_right;  ///< to 0.15 % of the radius or 0.5 px
  bool is_confident;
};

/// Detects the ball behind a blur disc of `share` of its radius. The results go to stdout.
Trial trial(const std::string& name, const cv::Mat& sharp, const Outline& truth, double share) {
  const cv::Mat pixels = defocused(sharp, share * truth.rx);
  const auto found = detect_ball(picture_of_mat(pixels));
  if (!found) return {false, false};
  const double off = outline_error(found->outline, truth);
  std::printf("%s, radius %.0f, disc %.1f %%: %.2f %%, %.1f px, confidence %.2f\n", name.c_str(),
              truth.rx, 100 * share, 100 * off / truth.rx, off, found->confidence);
  return {off <= std::max(0.0015 * truth.rx, 0.5), found->is_confident()};
}

/// Blur discs, as a share of the ball's radius.
constexpr double kHardly = 0.005, kFar = 0.02;

TEST(DefocusGate, SimulatedRooms) {
  const int cases = share_of(40);
  int confident_sharp = 0, confident_and_wrong = 0;
  for (int n = 0; n < cases; ++n) {
    MirrorRoomSettings settings = any_room(97'000 + static_cast<std::uint64_t>(n));
    settings.blur = 0.4;
    const MirrorRoomPicture room = mirror_room(settings);
    const Outline truth{room.limb.centre, room.limb.rx, room.limb.ry, 0};
    const std::string name = "room " + std::to_string(n);
    confident_sharp += trial(name, room.pixels, truth, kHardly).is_confident ? 1 : 0;
    for (const double share : {0.01, 0.015}) trial(name, room.pixels, truth, share);
    const Trial far = trial(name, room.pixels, truth, kFar);
    confident_and_wrong += far.is_confident && !far.is_right ? 1 : 0;
  }
  std::printf("%d of %d confident at %.1f %%, %d confident and wrong at %.1f %%\n", confident_sharp,
              cases, 100 * kHardly, confident_and_wrong, 100 * kFar);
  RecordProperty("confident_sharp", confident_sharp);
  RecordProperty("confident_and_wrong", confident_and_wrong);
  EXPECT_GE(confident_sharp, cases / 2);
  EXPECT_EQ(confident_and_wrong, 0);
}

TEST(DefocusGate, RenderedMachines) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures());
  const cv::FileStorage scene = open_rendered_scene();
  for (const cv::FileNode& cameras : scene["scenes"]) {
    for (const cv::FileNode& camera : cameras["cameras"]) {
      const cv::FileNode limb = camera["outline"];
      const Outline truth{{limb["cx"].real() - 0.5, limb["cy"].real() - 0.5},
                          limb["semi_major"].real(),
                          limb["semi_minor"].real(),
                          limb["major_axis_angle_deg"].real()};
      const std::string file = (rendered_pictures() / camera["image"].string()).string();
      const cv::Mat pixels = cv::imread(file, cv::IMREAD_ANYDEPTH | cv::IMREAD_ANYCOLOR);
      ASSERT_FALSE(pixels.empty()) << file;
      const std::string name = cameras.name() + " " + camera.name();
      const Trial far = trial(name, pixels, truth, kFar);
      EXPECT_TRUE(far.is_right || !far.is_confident) << name;
    }
  }
}

}  // namespace
}  // namespace orbwatch::tests
