// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "proc/align/detect/picture/slope_strip.h"
#include "proc/optics/vec.h"

namespace orbwatch::align {

/// The surroundings of a place: a row for each ray, columns outwards. Radii grow by the same share
/// from column to column, so that limbs of any size look alike; the unit grows with them.
class RingStrip : public SlopeStrip {
 public:
  static constexpr int kRays = 96;
  /// Radii of limbs whose surroundings are within the strip, px.
  static constexpr double kNearest = 15, kFarthest = 38;
  /// Columns on the inner and on the outer side of those limbs.
  static constexpr int kBeside = 12;
  /// The logarithm of the radii's ratio from one column to the next: a ray is three columns from
  /// the next, as in a LimbStrip.
  static constexpr double kGrowth = 2 * std::numbers::pi / kRays / 3;

  /// `luminance`: one channel, 8 or 16 bit; `centre` in its pixels.
  RingStrip(const cv::Mat& luminance, optics::Vec2 centre);

  static double radius(double column);  ///< px

 private:
  static Places places(optics::Vec2 centre);
};

}  // namespace orbwatch::align
