// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/limb/limb_likelihood.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "proc/align/detect/limb/limb_network.h"

namespace orbwatch::align {
namespace {

/// Number of independent parts that all together are worth; neighbouring parts see the same.
constexpr double kIndependent = 64;
/// Cost, nats per share of the radius, of an axis that differs from perspective's picture of a
/// sphere. Not by the square: some lenses and pixels do stretch balls.
constexpr double kShape = 3000;
/// The shortest expected focal length, in long sides of the picture.
constexpr double kShortestFocalLength = 0.55;

}  // namespace

LimbLikelihood::LimbLikelihood(const LimbStrip& strip, const optics::Outline& outline,
                               const cv::Size& picture)
    : columns_(static_cast<std::size_t>(strip.columns())),
      limb_(strip.limb()),
      radius_(optics::mean_radius(outline)),
      half_((outline.rx - outline.ry) / 2) {
  const LimbColumns limb = limb_columns(strip);
  parts_ = limb.above_random();
  for (int n = 0; n < limb.parts; ++n) {
    const double a = limb.angle(n);
    basis_.push_back({1, std::cos(a), std::sin(a), std::cos(2 * a), std::sin(2 * a)});
  }
  const double u = outline.centre.u - (picture.width - 1) / 2.0;
  const double v = outline.centre.v - (picture.height - 1) / 2.0;
  const double way = 2 * (std::atan2(v, u) - optics::radians(outline.angle));
  cos_middle_ = std::cos(way);
  sin_middle_ = std::sin(way);
  // A sphere at the angle b from the axis is longer by about 1 / cos b.
  const double tan_b =
      std::hypot(u, v) / (kShortestFocalLength * std::max(picture.width, picture.height));
  longest_ = std::min(tan_b * tan_b, 1.0) / 4;
}

double LimbLikelihood::shape(const Offset& offset) const {
  const double p = (half_ + offset[3]) / radius_, q = offset[4] / radius_;
  const double along = p * cos_middle_ + q * sin_middle_;
  const double across = q * cos_middle_ - p * sin_middle_;
  const double beyond = std::max({0.0, -along, along - longest_});
  return -kShape * std::hypot(beyond, across);
}

double LimbLikelihood::above_random(const Offset& offset) const {
  double sum = 0;
  for (std::size_t n = 0; n < basis_.size(); ++n) {
    double t = 0;
    for (std::size_t i = 0; i < offset.size(); ++i) t += basis_[n][i] * offset[i];
    const double place =
        std::clamp(limb_ + t * LimbStrip::kPerUnit, 0.0, static_cast<double>(columns_) - 1.001);
    const auto k = static_cast<std::size_t>(place);
    const float* row = &parts_[n * columns_];
    const double share = place - static_cast<double>(k);
    sum += (1 - share) * row[k] + share * row[k + 1];
  }
  return sum / static_cast<double>(basis_.size());
}

double LimbLikelihood::operator()(const Offset& offset) const {
  return kIndependent * above_random(offset) + shape(offset);
}

}  // namespace orbwatch::align
