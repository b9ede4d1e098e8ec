// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/limb/limb_score.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "proc/align/detect/limb/limb_strip.h"

namespace orbwatch::align {
namespace {

constexpr std::size_t kSectors = 32;
constexpr double kBeyondEdge = 1.5;      // px: outside, beyond the limb's own edge
constexpr double kUnknownOutside = 0.2;  // agreement where the picture ends at the limb
constexpr double kNearby = 8;            // px

/// The mean agreement of slopes with the normal, cos 2a; slopes within the noise count as 0.
struct Agreement {
  double sum = 0;
  int count = 0;

  void add(const LimbStrip::Slope& slope, float floor2) {
    sum += (2 * slope.share() - 1) * slope.energy() / (slope.energy() + floor2);
    ++count;
  }
  double mean(double otherwise) const { return count > 0 ? sum / count : otherwise; }
};

}  // namespace

double contour(const cv::Mat& luminance, const optics::Outline& outline) {
  const LimbStrip strip(luminance, outline, kNearby);
  double sum = 0;
  int seen = 0;
  for (int ray = 0; ray < strip.rays(); ++ray) {
    float here = 0, strongest = 0;
    bool limb_seen = true;
    for (int k = 0; k < strip.columns(); ++k) {
      const auto slope = strip.slope(ray, k);
      const bool on_limb = std::abs(k - strip.limb()) <= LimbStrip::kPerUnit;
      if (!slope) {
        limb_seen &= !on_limb;
        continue;
      }
      strongest = std::max(strongest, std::abs(slope->along));
      if (on_limb) here = std::max(here, std::abs(slope->along));
    }
    if (!limb_seen) continue;
    ++seen;
    if (strongest * strongest > strip.floor2()) sum += here / strongest;
  }
  return seen > 0 ? sum / seen : 0;
}

double near_drop(const cv::Mat& luminance, const optics::Outline& outline) {
  const double radius = optics::mean_radius(outline);
  const double near = std::max(3.0, 0.08 * radius);
  const LimbStrip strip(luminance, outline, std::max(5.0, 0.2 * radius));
  std::array<Agreement, kSectors> inside, outside;
  for (int ray = 0; ray < strip.rays(); ++ray) {
    const std::size_t sector = strip.sector(ray, kSectors);
    for (int k = 0; k < strip.columns(); ++k) {
      const double at = strip.distance(k);
      const auto slope = strip.slope(ray, k);
      if (!slope) continue;
      if (at > -near && at < 0) inside[sector].add(*slope, strip.floor2());
      if (at > kBeyondEdge && at < near + kBeyondEdge) outside[sector].add(*slope, strip.floor2());
    }
  }
  double sum = 0;
  int seen = 0;
  for (std::size_t s = 0; s < kSectors; ++s) {
    if (inside[s].count == 0) continue;
    const double out = std::max(0.0, outside[s].mean(kUnknownOutside));
    sum += std::clamp(inside[s].mean(0) - out, -0.5, 1.0);
    ++seen;
  }
  return seen > 0 ? sum / seen : 0;
}

}  // namespace orbwatch::align
