// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "proc/align/detect/picture/slope_strip.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// The surroundings of a limb: a row for each ray, columns along the limb's outward normal from
/// -reach to +reach pixels. The unit is the pixel.
class LimbStrip : public SlopeStrip {
 public:
  /// `luminance`: one channel, 8 or 16 bit; `outline` in its pixels, with axes above 0.
  LimbStrip(const cv::Mat& luminance, const optics::Outline& outline, double reach);

  int limb() const { return (columns() - 1) / 2; }  ///< the column on it
  /// Signed distance of a column from the limb, pixels.
  double distance(int column) const { return static_cast<double>(column - limb()) / kPerUnit; }
  /// Index of the ray's sector, out of `count` equal parts of the ellipse's own angle.
  std::size_t sector(int ray, std::size_t count) const {
    return static_cast<std::size_t>(ray) * count / static_cast<std::size_t>(rays());
  }

 private:
  static int rays_of(const optics::Outline& outline);
  static Places places(const optics::Outline& outline, int steps);
};

}  // namespace orbwatch::align
