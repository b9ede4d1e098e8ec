#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <vector>

#include "proc/align/detect/limb_strip.h"

namespace orbwatch::align {

/// An ellipse's small change as its offset along the normal, pixels, over the ellipse's own angle:
/// the factors of 1, cos, sin, cos 2, sin 2.
using Offset = std::array<double, 5>;

/// How likely the ball's limb lies there, by what limb_columns() sees in a strip, in nats. Some
/// parts may be wrong: a mount hides the limb, a reflection looks like it.
class LimbLikelihood {
 public:
  /// Of offsets from `outline` within `strip`, which was made of it, in a picture of that size.
  LimbLikelihood(const LimbStrip& strip, const optics::Outline& outline, const cv::Size& picture);

  double operator()(const Offset& offset) const;

  /// By how much that of the outline itself is above a limb's anywhere in a strip that tells
  /// nothing, nats per part: 1 to 3 for a ball, below 0 for most other things.
  double above_random() const;

 private:
  double seen(const Offset& offset) const;
  double shape(const Offset& offset) const;

  std::size_t columns_;
  double limb_;                ///< column
  std::vector<double> parts_;  ///< nats by part and column
  std::vector<Offset> basis_;  ///< by part
  // Of the outline: its mean radius, half the difference of its axes, the direction to the middle
  // of the picture in twice its own angle, and how long it may be for its place.
  double radius_, half_, cos_middle_, sin_middle_, longest_;
};

}  // namespace orbwatch::align
