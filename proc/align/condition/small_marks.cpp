// SPDX-License-Identifier: Apache-2.0
#include "proc/align/condition/small_marks.h"

#include <algorithm>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace orbwatch::align {
namespace {

constexpr double kOutermost = 0.93;   // rho; all reflections beyond it are thin
constexpr double kSmoothing = 0.7;    // px
constexpr double kDetailBlur = 4;     // px: the scale of detail
constexpr double kWideBlur = 16;      // px: the scale of the surroundings
constexpr float kNoiseReach = 3;      // multiple of the noise that a top hat reaches without a mark
constexpr double kBrightShare = 0.9;  // share of pixels that are darker than the bright level
// Share of the bright level; added to the divisor of relative differences.
constexpr float kRelativeFloor = 0.05F;
constexpr float kDark = 0.06F;       // share of the bright level below which nothing is judged
constexpr float kTooBright = 0.95F;  // share of full scale

/// Reference levels of the picture, counts.
struct Lighting {
  float floor, noise, dark, clipped;
};

float bright_level(const cv::Mat& brightness) {
  std::vector<float> inside;
  for (int v = 0; v < brightness.rows; v += 2) {
    for (int u = 0; u < brightness.cols; u += 2) {
      if (raster_rho(u, v) < kOutermost) inside.push_back(brightness.at<float>(v, u));
    }
  }
  const auto place = inside.begin() + static_cast<std::ptrdiff_t>(
                                          kBrightShare * static_cast<double>(inside.size() - 1));
  std::nth_element(inside.begin(), place, inside.end());
  return *place;
}

Lighting lighting_of(const cv::Mat& smooth, const BallRaster& raster) {
  const float bright = bright_level(smooth), noise = static_cast<float>(raster.noise);
  return {kRelativeFloor * bright, kNoiseReach * noise,
          std::max(kDark * bright, 4 * kNoiseReach * noise),
          kTooBright * static_cast<float>(raster.full_scale)};
}

std::uint8_t share(float part, float whole) {
  return cv::saturate_cast<std::uint8_t>(255 * std::max(part, 0.F) / whole);
}

std::uint8_t around_128(float difference, float whole) {
  return cv::saturate_cast<std::uint8_t>(128 + 127 * difference / whole);
}

}  // namespace

SmallMarks SmallMarks::none() {
  SmallMarks marks;
  for (const auto map : maps()) marks.*map = cv::Mat::zeros(kRasterSide, kRasterSide, CV_8U);
  return marks;
}

SmallMarks small_marks(const BallRaster& raster, int widest) {
  cv::Mat smooth, closed, mean, unmarked, wide;
  cv::GaussianBlur(raster.brightness, smooth, {}, kSmoothing);
  const cv::Mat disc = cv::getStructuringElement(cv::MORPH_ELLIPSE, {widest, widest});
  cv::morphologyEx(smooth, closed, cv::MORPH_CLOSE, disc);
  // Opening the closed picture, so that the remains around a dark mark do not count as a bright
  // one.
  cv::morphologyEx(closed, unmarked, cv::MORPH_OPEN, disc);
  cv::GaussianBlur(smooth, mean, {}, kDetailBlur);
  cv::GaussianBlur(unmarked, wide, {}, kWideBlur);
  const Lighting light = lighting_of(smooth, raster);
  SmallMarks marks = SmallMarks::none();
  for (int v = 0; v < smooth.rows; ++v) {
    for (int u = 0; u < smooth.cols; ++u) {
      const float here = smooth.at<float>(v, u), high = closed.at<float>(v, u),
                  around = mean.at<float>(v, u);
      const bool is_judged =
          raster_rho(u, v) < kOutermost && high > light.dark && around < light.clipped;
      if (!is_judged) continue;
      marks.judged.at<std::uint8_t>(v, u) = 255;
      marks.dark.at<std::uint8_t>(v, u) = share(high - here - light.noise, high + light.floor);
      const float near = unmarked.at<float>(v, u), far = wide.at<float>(v, u);
      if (here < light.clipped) {
        marks.bright.at<std::uint8_t>(v, u) = share(here - near - light.noise, here + light.floor);
      }
      marks.detail.at<std::uint8_t>(v, u) = around_128(here - around, around + light.floor);
      marks.around.at<std::uint8_t>(v, u) = around_128(near - far, near + far + light.floor);
    }
  }
  return marks;
}

}  // namespace orbwatch::align
