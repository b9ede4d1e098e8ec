// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/picture/slope_strip.h"

#include <algorithm>
#include <limits>
#include <opencv2/imgproc.hpp>
#include <vector>

namespace orbwatch::align {
namespace {

constexpr int kWrapped = 4;  // rays around the ring, reached by filters

}  // namespace

SlopeStrip::SlopeStrip(const cv::Mat& luminance, const Places& places, double rays_per_unit,
                       double margin) {
  cv::Mat ring;
  cv::remap(luminance, ring, places.u, places.v, cv::INTER_LINEAR, cv::BORDER_CONSTANT, 0);
  ring.convertTo(ring, CV_32F);
  cv::copyMakeBorder(ring, ring, kWrapped, kWrapped, 0, 0, cv::BORDER_WRAP);
  cv::GaussianBlur(ring, ring, {}, 0.7 * kPerUnit, 0.7);
  cv::Mat along, across;
  cv::Scharr(ring, along, CV_32F, 1, 0, kPerUnit / 32.0);
  cv::Scharr(ring, across, CV_32F, 0, 1, rays_per_unit / 32);
  along_ = along.rowRange(kWrapped, kWrapped + places.u.rows);
  across_ = across.rowRange(kWrapped, kWrapped + places.u.rows);
  const cv::Mat beyond = (places.u < margin) | (places.v < margin) |
                         (places.u > static_cast<double>(luminance.cols - 1) - margin) |
                         (places.v > static_cast<double>(luminance.rows - 1) - margin);
  along_.setTo(std::numeric_limits<float>::quiet_NaN(), beyond);
  floor2_ = measured_floor2();
}

float SlopeStrip::measured_floor2() const {
  std::vector<float> sample;
  for (int ray = 0; ray < rays(); ray += 5) {
    for (int k = 0; k < columns(); k += 3) {
      if (const auto here = slope(ray, k)) sample.push_back(here->energy());
    }
  }
  if (sample.empty()) return 1;
  const auto third = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 3);
  std::nth_element(sample.begin(), third, sample.end());
  return std::max(*third * 0.3F, 1e-4F);
}

}  // namespace orbwatch::align
