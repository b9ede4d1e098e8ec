// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/ring/ring_strip.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace orbwatch::align {
namespace {

constexpr double kPoorBorder = 1;  // px: a limb near the picture's border has few pixels
constexpr double kRaysPerUnit = SlopeStrip::kPerUnit / 3.0;

}  // namespace

RingStrip::RingStrip(const cv::Mat& luminance, optics::Vec2 centre)
    : SlopeStrip(luminance, places(centre), kRaysPerUnit, kPoorBorder) {}

double RingStrip::radius(double column) {
  return kNearest * std::exp(kGrowth * (column - kBeside));
}

SlopeStrip::Places RingStrip::places(optics::Vec2 centre) {
  const int between = static_cast<int>(std::ceil(std::log(kFarthest / kNearest) / kGrowth));
  const int columns = between + 1 + 2 * kBeside;
  std::vector<double> radii;
  radii.reserve(static_cast<std::size_t>(columns));
  for (int k = 0; k < columns; ++k) radii.push_back(radius(k));
  Places places(kRays, columns);
  for (int ray = 0; ray < kRays; ++ray) {
    const double angle = 2 * std::numbers::pi * ray / kRays;
    const double c = std::cos(angle), s = std::sin(angle);
    for (int k = 0; k < columns; ++k) {
      const double r = radii[static_cast<std::size_t>(k)];
      places.u.at<float>(ray, k) = static_cast<float>(centre.u + r * c);
      places.v.at<float>(ray, k) = static_cast<float>(centre.v + r * s);
    }
  }
  return places;
}

}  // namespace orbwatch::align
