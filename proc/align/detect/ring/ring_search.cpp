// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/ring/ring_search.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "proc/align/detect/limb/limb_network.h"
#include "proc/align/detect/ring/ring_strip.h"

namespace orbwatch::align {
namespace {

/// Offsets of the centre from the place, shares of the radius; a limb that is off crosses at most
/// the columns that it has beside it.
constexpr double kFarthestOff = 0.25, kOffStep = 0.04;
static_assert(kFarthestOff < (RingStrip::kBeside + 0.5) * RingStrip::kGrowth);

/// Likeness of circles in a strip, by column.
class Rings {
 public:
  explicit Rings(const RingStrip& strip) : limb_(limb_columns(strip)), nats_(limb_.above_random()) {
    for (int n = 0; n < limb_.parts; ++n) cosines_.push_back(std::cos(limb_.angle(n)));
    for (int n = 0; n < limb_.parts; ++n) sines_.push_back(std::sin(limb_.angle(n)));
    sums_.resize(static_cast<std::size_t>(limb_.columns));
  }

  /// A circle whose centre is off by (u, v) radii.
  struct Circle {
    double u, v;
    int column;
    float likeness;
  };
  /// Adds the circles with one centre, of all radii.
  void add(double u, double v, std::vector<Circle>& all) {
    std::ranges::fill(sums_, 0.F);
    const int end = limb_.columns - RingStrip::kBeside;
    for (std::size_t n = 0; n < cosines_.size(); ++n) {
      const auto shift =
          static_cast<int>(std::lround((u * cosines_[n] + v * sines_[n]) / RingStrip::kGrowth));
      const float* row = &nats_[n * sums_.size()];
      for (int k = RingStrip::kBeside; k < end; ++k)
        sums_[static_cast<std::size_t>(k)] += row[k + shift];
    }
    for (int k = RingStrip::kBeside; k < end; ++k) {
      const float sum = sums_[static_cast<std::size_t>(k)];
      all.push_back({u, v, k, sum / static_cast<float>(limb_.parts)});
    }
  }

 private:
  LimbColumns limb_;
  std::vector<float> nats_;
  std::vector<double> cosines_, sines_;
  std::vector<float> sums_;
};

std::vector<Ring> all_rings(const cv::Mat& luminance, optics::Vec2 place) {
  Rings rings(RingStrip(luminance, place));
  std::vector<Rings::Circle> circles;
  constexpr int kSteps = static_cast<int>(kFarthestOff / kOffStep);
  for (int i = -kSteps; i <= kSteps; ++i) {
    for (int j = -kSteps; j <= kSteps; ++j) {
      if (i * i + j * j <= kSteps * kSteps) rings.add(i * kOffStep, j * kOffStep, circles);
    }
  }
  std::vector<Ring> all;
  all.reserve(circles.size());
  for (const Rings::Circle& circle : circles) {
    const double r = RingStrip::radius(circle.column);
    all.push_back({{place.u + circle.u * r, place.v + circle.v * r}, r, circle.likeness});
  }
  return all;
}

/// True for two rings so close that a fit of one may well find the other.
bool is_beside(const Ring& a, const Ring& b) {
  constexpr double kApart = 0.1;  // radii
  const double apart = std::hypot(a.centre.u - b.centre.u, a.centre.v - b.centre.v);
  return std::max(apart, std::abs(a.radius - b.radius)) < kApart * std::min(a.radius, b.radius);
}

}  // namespace

std::vector<Ring> likeliest_rings(const cv::Mat& luminance, optics::Vec2 place, std::size_t most) {
  std::vector<Ring> all = all_rings(luminance, place), found;
  while (found.size() < most && !all.empty()) {
    const Ring best = *std::ranges::max_element(all, {}, &Ring::likeness);
    found.push_back(best);
    std::erase_if(all, [&](const Ring& other) { return is_beside(other, best); });
  }
  return found;
}

}  // namespace orbwatch::align
