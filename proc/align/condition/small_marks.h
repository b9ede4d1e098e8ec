// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "proc/align/condition/ball_raster.h"

namespace orbwatch::align {

/// Small things in a ball's picture, on the ball or reflected: maps of 8 bit, kRasterSide squared.
/// Depths are relative to the surrounding brightness, 255 for all of it, so that exposure does not
/// count.
struct SmallMarks {
  cv::Mat dark;    ///< depth below the surroundings
  cv::Mat bright;  ///< height above the surroundings, as a share of the mark's own brightness
  /// All fine detail: 128 + 127 times the relative difference from the mean around.
  cv::Mat detail;
  cv::Mat around;  ///< the same at a larger scale, of the brightness without marks
  /// 255 where the other maps are valid: on the ball, neither dark nor overexposed.
  cv::Mat judged;

  static constexpr std::array<cv::Mat SmallMarks::*, 5> maps() {
    return {&SmallMarks::dark, &SmallMarks::bright, &SmallMarks::detail, &SmallMarks::around,
            &SmallMarks::judged};
  }
  /// A set of zero maps.
  static SmallMarks none();
};

/// `widest`: largest width of a mark, px. Marks are what a morphological closing or opening of that
/// width removes (top hats), so that edges of larger things do not count. Depths within the noise
/// are removed; an overexposed place is a lamp, not a mark. Reentrant.
SmallMarks small_marks(const BallRaster& raster, int widest);

}  // namespace orbwatch::align
