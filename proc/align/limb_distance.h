// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "proc/optics/outline.h"

namespace orbwatch::align {

/// Distances from the middle of the ball, 1 at the limb: for many pixels of one outline. Reentrant,
/// immutable.
class LimbDistance {
 public:
  explicit LimbDistance(const optics::Outline& outline) {
    const double turn = optics::radians(outline.angle), c = std::cos(turn), s = std::sin(turn);
    along_ = {c / outline.rx, s / outline.rx};
    across_ = {-s / outline.ry, c / outline.ry};
  }

  /// `arm`: px, from the outline's centre.
  double squared(const optics::Vec2& arm) const {
    const double along = arm.u * along_.u + arm.v * along_.v;
    const double across = arm.u * across_.u + arm.v * across_.v;
    return along * along + across * across;
  }
  double of(const optics::Vec2& arm) const { return std::sqrt(squared(arm)); }

 private:
  optics::Vec2 along_, across_;  ///< the axes, divided by their lengths
};

}  // namespace orbwatch::align
