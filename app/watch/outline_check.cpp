// SPDX-License-Identifier: Apache-2.0
#include "app/watch/outline_check.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/alignment/found_outline.h"
#include "proc/align/limb_distance.h"

namespace orbwatch::app {
namespace {

/// An outline that is found for sure was never further off than the larger of these, in 600
/// simulated rooms: see "far off" in proc/align/README.md. Their 95th percentile is 1.3 % or 1.6
/// px. What is beyond is the stated outline's error.
constexpr double kFarOffShare = 0.02, kFarOffPixels = 3;

/// The largest distance of a point of `found` from the limb `stated`, along its radius, px.
double limb_offset(const optics::Outline& found, const optics::Outline& stated) {
  constexpr int kPoints = 72;
  const align::LimbDistance distance(stated);
  const double turn = optics::radians(found.angle), c = std::cos(turn), s = std::sin(turn);
  double largest = 0;
  for (int n = 0; n < kPoints; ++n) {
    const double angle = 2 * std::numbers::pi * n / kPoints;
    const double along = found.rx * std::cos(angle), across = found.ry * std::sin(angle);
    const optics::Vec2 arm{found.centre.u + c * along - s * across - stated.centre.u,
                           found.centre.v + s * along + c * across - stated.centre.v};
    const double length = std::hypot(arm.u, arm.v), radii = distance.of(arm);
    // The stated centre itself is a whole radius from its limb.
    const double offset =
        radii > 0 ? std::abs(length - length / radii) : optics::mean_radius(stated);
    largest = std::max(largest, offset);
  }
  return largest;
}

}  // namespace

OutlineCheck check_outline(const Picture& picture, const optics::Outline& stated) {
  const auto ball = align::detect_ball(picture);
  if (!ball) return {.doubt = ball.error().message};
  if (!ball->is_confident()) return {.doubt = doubt_text(*ball)};
  const double radius = optics::mean_radius(stated), offset = limb_offset(ball->outline, stated);
  const bool is_aligned = offset <= std::max(kFarOffShare * radius, kFarOffPixels);
  return {.state = is_aligned ? OutlineState::Aligned : OutlineState::NotAligned,
          .doubt = {},
          .offset_px = offset,
          .offset_percent = 100 * offset / radius};
}

}  // namespace orbwatch::app
