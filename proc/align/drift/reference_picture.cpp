// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/reference_picture.h"

#include <algorithm>
#include <vector>

#include "proc/align/drift/fault.h"
#include "proc/align/drift/patch_window.h"
#include "proc/align/drift/picture_motion.h"
#include "proc/align/limb_distance.h"

namespace orbwatch::align {
namespace {

using optics::Outline;

/// Share of the range below which a mean brightness is too dark.
constexpr double kDarkest = 0.02;

/// Brightness of the pixels within a limb.
struct BrightnessWithin {
  double pixels = 0;
  double saturated = 0;  ///< number of pixels
  double sum = 0;
};

/// The part of a picture that contains the limb.
cv::Rect part_around(const Outline& limb, const cv::Size& picture) {
  const double reach = std::max(limb.rx, limb.ry);
  const cv::Point low(cvFloor(limb.centre.u - reach), cvFloor(limb.centre.v - reach));
  const cv::Point high(cvCeil(limb.centre.u + reach) + 1, cvCeil(limb.centre.v + reach) + 1);
  return cv::Rect(low, high) & cv::Rect({0, 0}, picture);
}

BrightnessWithin brightness_within(const Outline& limb, const cv::Mat& luminance, float saturated) {
  const LimbDistance distance(limb);
  const cv::Rect part = part_around(limb, luminance.size());
  BrightnessWithin within;
  for (int v = part.y; v < part.y + part.height; ++v) {
    const float* const row = luminance.ptr<float>(v);
    for (int u = part.x; u < part.x + part.width; ++u) {
      if (distance.squared({u - limb.centre.u, v - limb.centre.v}) > 1) continue;
      ++within.pixels;
      within.saturated += row[u] >= saturated ? 1 : 0;
      within.sum += static_cast<double>(row[u]);
    }
  }
  return within;
}

}  // namespace

void ReferencePicture::add(const Picture& picture) {
  pictures_.push_back(smoothed_luminance(picture, scale_));
}

cv::Mat ReferencePicture::median() const {
  // A bubble sort of all pixels at once, from the largest on until the middle.
  std::vector<cv::Mat> sorted;
  for (const cv::Mat& picture : pictures_) sorted.push_back(picture.clone());
  cv::Mat lower;
  for (std::size_t end = sorted.size(); end > sorted.size() / 2; --end) {
    for (std::size_t n = 1; n < end; ++n) {
      cv::min(sorted[n - 1], sorted[n], lower);
      cv::max(sorted[n - 1], sorted[n], sorted[n]);
      cv::swap(sorted[n - 1], lower);
    }
  }
  return sorted[sorted.size() / 2];
}

bool is_too_dark(double brightness, PixelFormat format) {
  return format != PixelFormat::Y16 && brightness < kDarkest * saturation(format);
}

std::string_view exposure_fault(const Picture& picture, const Outline& outline) {
  constexpr double kRadius = 200;  // px: enough to judge
  const int half = static_cast<int>((outline.rx + outline.ry) / 4 / kRadius);
  const int scale = std::max(1, 2 * half);
  const BrightnessWithin ball = brightness_within(
      reduced(outline, scale), smoothed_luminance(picture, scale), saturation(picture.format));
  if (ball.pixels == 0) return fault::kOutside;
  if (2 * ball.saturated > ball.pixels) return fault::kOverexposed;
  return is_too_dark(ball.sum / ball.pixels, picture.format) ? fault::kDark : std::string_view{};
}

}  // namespace orbwatch::align
