// SPDX-License-Identifier: Apache-2.0
#include "proc/align/detect/limb/limb_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "proc/align/detect/limb/limb_likelihood.h"

namespace orbwatch::align {
namespace {

using optics::Outline;

constexpr double kLastStep = 0.05;   // px
constexpr double kSmallestAxis = 4;  // px: an ellipse with smaller axes has no limb

/// Hill climber; keeps the best offset so far.
struct Climber {
  const LimbLikelihood& likelihood;
  Offset best{};
  double most = likelihood(best);

  void take(const Offset& next) {
    const double l = likelihood(next);
    if (l > most) most = l, best = next;
  }

  /// Searches circles all around.
  void search(double reach) {
    constexpr int kPlaces = 3;
    const double far = 0.75 * reach, step = std::max(0.5, reach / 16);
    for (int i = -kPlaces; i <= kPlaces; ++i) {
      for (int j = -kPlaces; j <= kPlaces; ++j) {
        for (double r = -far; r <= far; r += step) {
          take({r, i * far / kPlaces, j * far / kPlaces, 0, 0});
        }
      }
    }
  }

  /// Varies each factor by a step, and the width with one side fixed.
  bool climb(double step) {
    const Offset from = best;
    for (const double way : {step, -step}) {
      for (std::size_t i = 0; i < from.size(); ++i) {
        Offset next = from;
        next[i] += way;
        take(next);
      }
      for (const double u : {-1.0, 0.0, 1.0}) {
        for (const double v : {-1.0, 0.0, 1.0}) {
          take({from[0] + way, from[1] + u * way, from[2] + v * way, from[3], from[4]});
        }
      }
    }
    return best != from;
  }
};

/// The outline moved by an offset; for ellipses that are nearly circles.
Outline moved(const Outline& outline, const Offset& offset) {
  const double turn = optics::radians(outline.angle), c = std::cos(turn), s = std::sin(turn);
  const double mean = (outline.rx + outline.ry) / 2 + offset[0];
  const double cos2 = (outline.rx - outline.ry) / 2 + offset[3], sin2 = offset[4];
  const double half = std::hypot(cos2, sin2);
  return {{outline.centre.u + offset[1] * c - offset[2] * s,
           outline.centre.v + offset[1] * s + offset[2] * c},
          mean + half,
          mean - half,
          outline.angle + optics::degrees(std::atan2(sin2, cos2) / 2)};
}

}  // namespace

LimbFit fit_limb(const cv::Mat& luminance, const Outline& outline, double reach) {
  if (std::min(outline.rx, outline.ry) < reach + kSmallestAxis) {
    return {outline, std::numeric_limits<double>::lowest()};
  }
  const LimbStrip strip(luminance, outline, reach);
  const LimbLikelihood likelihood(strip, outline, luminance.size());
  Climber climber{likelihood};
  climber.search(reach);
  for (double step = reach / 4; step > kLastStep; step *= 0.6) {
    for (int round = 0; round < 8 && climber.climb(step); ++round) continue;
  }
  return {moved(outline, climber.best), likelihood.above_random(climber.best)};
}

}  // namespace orbwatch::align
