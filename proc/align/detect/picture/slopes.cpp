// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/picture/slopes.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace orbwatch::align {
namespace {

/// The median magnitude, from every ninth pixel.
float median_magnitude(const Slopes& slopes) {
  std::vector<float> sample;
  for (int v = 1; v < slopes.height(); v += 3) {
    for (int u = 1; u < slopes.width(); u += 3) {
      sample.push_back(std::hypot(slopes.along_u.at<float>(v, u), slopes.along_v.at<float>(v, u)));
    }
  }
  if (sample.empty()) return 0;
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), middle, sample.end());
  return *middle;
}

}  // namespace

Slopes slopes_of(const cv::Mat& luminance) {
  constexpr double kBlur = 0.8;         // px
  constexpr double kScharr = 1 / 32.0;  // inverse of its weights' sum
  cv::Mat smooth;
  luminance.convertTo(smooth, CV_32F);
  cv::GaussianBlur(smooth, smooth, {}, kBlur);
  Slopes slopes;
  cv::Scharr(smooth, slopes.along_u, CV_32F, 1, 0, kScharr);
  cv::Scharr(smooth, slopes.along_v, CV_32F, 0, 1, kScharr);
  // The median may be 0 in a picture without noise.
  const float floor = std::max(0.6F * median_magnitude(slopes), 2e-3F);
  slopes.floor2 = floor * floor;
  return slopes;
}

}  // namespace orbwatch::align
