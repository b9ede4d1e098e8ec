// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "proc/optics/outline.h"

namespace orbwatch::align {

/// Finds likely places of a ball in a picture, at any distance: correlation of the directions of
/// slopes, independent of their strength (Fitch et al., orientation correlation, 2002). Reentrant,
/// immutable.
class ShiftSearch {
 public:
  /// `picture`: a small reference, 32F. The ball within `outline` is searched for.
  ShiftSearch(const cv::Mat& picture, const optics::Outline& outline);

  /// The most likely shifts, px, the best first. `picture` has the reference's size.
  std::vector<optics::Vec2> run(const cv::Mat& picture) const;

 private:
  cv::Size padded_;
  cv::Mat spectrum_;  ///< spectrum of the reference's ball
};

}  // namespace orbwatch::align
