// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/reference_picture.h"

#include <algorithm>
#include <vector>

#include "proc/align/drift/fault.h"
#include "proc/align/drift/patch_window.h"

namespace orbwatch::align {
namespace {

/// Share of the range below which a picture's mean is too dark.
constexpr double kDarkest = 0.02;

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

std::string_view exposure_fault(const Picture& picture, const optics::Outline& outline) {
  constexpr double kRadius = 200;  // px: enough to judge
  const int half = static_cast<int>((outline.rx + outline.ry) / 4 / kRadius);
  const int scale = std::max(1, 2 * half);
  const cv::Mat luminance = smoothed_luminance(picture, scale);
  const double range = saturation(picture.format);
  const double bright = cv::countNonZero(luminance >= range);
  if (2 * bright > static_cast<double>(luminance.total())) return fault::kOverexposed;
  const bool is_light = picture.format != PixelFormat::Y16;  // Y16 may be temperatures
  const bool is_dark = is_light && cv::mean(luminance)[0] < kDarkest * range;
  return is_dark ? fault::kDark : std::string_view{};
}

}  // namespace orbwatch::align
