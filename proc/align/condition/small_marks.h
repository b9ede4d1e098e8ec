#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "proc/align/condition/ball_raster.h"

namespace orbwatch::align {

/// What is small in a ball's picture, whether it lies on the ball or is reflected: maps of 8 bit,
/// kRasterSide squared. Depths are relative to the brightness around, 255 for all of it, so that
/// exposure does not count.
struct SmallMarks {
  cv::Mat dark;    ///< how much darker than the surroundings
  cv::Mat bright;  ///< how much brighter, as a share of the mark's own brightness
  cv::Mat
      detail;  ///< all fine detail: 128 + 127 times the relative difference from the mean around
  cv::Mat around;  ///< the same of the brightness without marks and of that much farther around
  cv::Mat judged;  ///< 255 where that can be said: on the ball, neither dark nor overexposed

  static constexpr std::array<cv::Mat SmallMarks::*, 5> maps() {
    return {&SmallMarks::dark, &SmallMarks::bright, &SmallMarks::detail, &SmallMarks::around,
            &SmallMarks::judged};
  }
  /// Maps of zeros.
  static SmallMarks none();
};

/// `widest`: of a mark, px. Marks are what a morphological closing or opening of that width removes
/// (top hats), so that edges of larger things are none. What noise may be is not in it; what is
/// overexposed is a lamp and no mark. Reentrant.
SmallMarks small_marks(const BallRaster& raster, int widest);

}  // namespace orbwatch::align
