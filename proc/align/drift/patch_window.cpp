// SPDX-License-Identifier: Apache-2.0
#include "proc/align/drift/patch_window.h"

#include <algorithm>

#include <opencv2/imgproc.hpp>
#include <utility>

#include "proc/align/detect/picture/luminance.h"

namespace orbwatch::align {
namespace {

constexpr int kSide = PatchWindow::kSide;
/// Side including the pixel around that smoothing needs.
constexpr int kRawSide = BrightnessReader::kSide;
static_assert(kRawSide == kSide + 2);
/// Share of a format's range.
constexpr double kSaturated = 0.98;
/// Saturated pixels that make a window unusable.
constexpr int kMostSaturated = kSide * kSide / 10;

cv::Mat smoothed(const cv::Mat& picture) {
  const cv::Matx13f binomial(0.25F, 0.5F, 0.25F);
  cv::Mat out;
  cv::sepFilter2D(picture, out, CV_32F, binomial, binomial, {-1, -1}, 0, cv::BORDER_REPLICATE);
  return out;
}

/// The brightness of a picture at the scale; reads only the first plane.
cv::Mat reduced_luminance(const Picture& picture, int scale) {
  constexpr int kDense = BrightnessReader::kDense;
  const cv::Size size(picture.width / scale, picture.height / scale);
  const int skip = std::max(1, scale / kDense);
  Picture sparse = picture;
  sparse.width = size.width * scale;
  sparse.height = size.height * scale / skip;
  sparse.planes[0].stride *= skip;
  cv::Mat luminance = luminance_of(sparse), reduced;
  if (scale == 1) return luminance;
  if (skip > 1) {
    cv::resize(luminance, reduced, size * kDense, 0, 0, cv::INTER_NEAREST);
    std::swap(luminance, reduced);
  }
  cv::resize(luminance, reduced, size, 0, 0, cv::INTER_AREA);
  return reduced;
}

void mark_saturation(float saturated, PatchWindow& window) {
  const auto count = std::count_if(window.values.begin(), window.values.end(),
                                   [&](float value) { return value >= saturated; });
  window.is_saturated = count > kMostSaturated;
}

}  // namespace

float saturation(PixelFormat format) {
  return static_cast<float>(kSaturated * ((1 << info(format).bits) - 1));
}

cv::Mat smoothed_luminance(const Picture& picture, int scale) {
  return smoothed(reduced_luminance(picture, scale));
}

cv::Mat halved(const cv::Mat& picture) {
  const cv::Size half(picture.cols / 2, picture.rows / 2);
  cv::Mat reduced;
  cv::resize(picture({0, 0, 2 * half.width, 2 * half.height}), reduced, half, 0, 0, cv::INTER_AREA);
  return smoothed(reduced);
}

bool WindowReader::read(const Picture& picture, cv::Point corner, PatchWindow& window) {
  if (!reader_.read(picture, (corner - cv::Point(1, 1)) * scale_, samples_)) return false;
  std::array<float, kRawSide> column;
  for (int v = 0; v < kSide; ++v) {
    const float* const above = samples_.data() + v * kRawSide;
    const float* const middle = above + kRawSide;
    const float* const below = middle + kRawSide;
    for (std::size_t u = 0; u < kRawSide; ++u) {
      column[u] = 0.25F * (above[u] + below[u]) + 0.5F * middle[u];
    }
    float* const out = window.values.data() + v * kSide;
    for (std::size_t u = 0; u < kSide; ++u) {
      out[u] = 0.25F * (column[u] + column[u + 2]) + 0.5F * column[u + 1];
    }
  }
  mark_saturation(saturation(picture.format), window);
  return true;
}

bool read_window(const cv::Mat& picture, cv::Point corner, float saturated, PatchWindow& window) {
  const cv::Rect part(corner.x, corner.y, kSide, kSide);
  if ((part & cv::Rect(0, 0, picture.cols, picture.rows)) != part) return false;
  for (int v = 0; v < kSide; ++v) {
    std::copy_n(picture.ptr<float>(corner.y + v) + corner.x, kSide,
                window.values.begin() + v * kSide);
  }
  mark_saturation(saturated, window);
  return true;
}

}  // namespace orbwatch::align
