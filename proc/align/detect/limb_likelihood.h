#pragma once

#include <array>
#include <cstddef>
#include <opencv2/core.hpp>
#include <vector>

#include "proc/align/detect/limb_strip.h"

namespace orbwatch::align {

/// An ellipse's small change as its offset along the normal, pixels, over the ellipse's own angle:
/// the factors of 1, cos, sin, cos 2, sin 2.
using Offset = std::array<double, 5>;

/// How likely the ball's limb lies there, by what a strip shows, in nats: at each sector's limb an
/// edge should stand, with slopes along the normal inside of it and random ones outside, and slopes
/// should fade outward by the limb_profile. Some sectors may be wrong: a mount hides the limb, a
/// reflection looks like it.
class LimbLikelihood {
 public:
  /// Of offsets from `outline` within `strip`, which was made of it, in a picture of that size.
  LimbLikelihood(const LimbStrip& strip, const optics::Outline& outline, const cv::Size& picture);

  double operator()(const Offset& offset) const;

  /// By how much that is above a limb's anywhere in a strip that tells nothing, nats per sector: 2
  /// to 4 for what ends as a ball does, below 1 for most other round things.
  double above_random(const Offset& offset) const;

 private:
  static constexpr std::size_t kSectors = 64;

  void add_slopes(const LimbStrip& strip, int ray, double* sums) const;
  void add_edges(const LimbStrip& strip, int ray, double* sums) const;
  void add_profile(const LimbStrip& strip, int ray, float* sums) const;
  double shape(const Offset& offset) const;

  std::size_t columns_;
  double limb_;                  ///< column
  std::vector<double> sectors_;  ///< nats by sector and column
  std::array<Offset, kSectors> basis_;
  // Of the outline: its mean radius, half the difference of its axes, the direction to the middle
  // of the picture in twice its own angle, and how long it may be for its place.
  double radius_, half_, cos_middle_, sin_middle_, longest_;
};

}  // namespace orbwatch::align
