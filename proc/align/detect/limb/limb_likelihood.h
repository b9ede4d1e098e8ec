// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "proc/align/detect/limb/limb_strip.h"

namespace orbwatch::align {

/// A small change of an ellipse as its offset along the normal, pixels, over the ellipse's own
/// angle: the factors of 1, cos, sin, cos 2, sin 2.
using Offset = std::array<double, 5>;

/// Likelihood that the ball's limb is at an offset, from limb_columns() of a strip, in nats.
class LimbLikelihood {
 public:
  /// For offsets from `outline` within `strip`, which was made from it. `picture`: the picture's
  /// size, px.
  LimbLikelihood(const LimbStrip& strip, const optics::Outline& outline, const cv::Size& picture);

  double operator()(const Offset& offset) const;

  /// LimbColumns::above_random() of an offset, the mean of all parts: 1 to 3 for a ball, below 0
  /// for most other things.
  double above_random(const Offset& offset = {}) const;

 private:
  double shape(const Offset& offset) const;

  std::size_t columns_;
  double limb_;                ///< column
  std::vector<float> parts_;   ///< LimbColumns::above_random()
  std::vector<Offset> basis_;  ///< factors of the offset, one per part
  // The outline's mean radius, half the difference of its axes, the direction to the middle of the
  // picture in twice its own angle, and the greatest elongation for its place.
  double radius_, half_, cos_middle_, sin_middle_, longest_;
};

}  // namespace orbwatch::align
