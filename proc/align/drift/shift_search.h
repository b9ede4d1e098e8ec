#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "proc/optics/outline.h"

namespace orbwatch::align {

/// Where a ball may have gone in a picture, from any distance: correlation of the directions of
/// slopes, whatever their strength (Fitch et al., orientation correlation, 2002). Reentrant,
/// immutable.
class ShiftSearch {
 public:
  /// `picture`: a small reference, 32F. The ball within `outline` is searched for.
  ShiftSearch(const cv::Mat& picture, const optics::Outline& outline);

  /// The most likely shifts, px, the best first. `picture` is of the reference's size.
  std::vector<optics::Vec2> run(const cv::Mat& picture) const;

 private:
  cv::Size padded_;
  cv::Mat spectrum_;  ///< of the reference's ball
};

}  // namespace orbwatch::align
