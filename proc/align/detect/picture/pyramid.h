// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "proc/optics/outline.h"

namespace orbwatch::align {

/// A brightness picture and its halves, down to a long side below 2 kSmallest. Pixels of all levels
/// have their centres at integers. Immutable; reentrant.
class Pyramid {
 public:
  static constexpr int kSmallest = 32;

  /// `luminance`: one channel, 8 or 16 bit; shared, not copied.
  explicit Pyramid(const cv::Mat& luminance);

  std::size_t size() const { return levels_.size(); }
  const cv::Mat& level(std::size_t n) const { return levels_[n]; }  ///< 0: the picture itself

  /// The finest level at which `outline`, in the picture's pixels, has a radius of at most 1.5
  /// `radius` pixels; the coarsest if none has.
  std::size_t level_for(const optics::Outline& outline, double radius) const;

  /// An outline in one level's pixels in another's.
  static optics::Outline between(const optics::Outline& outline, std::size_t from, std::size_t to);

 private:
  std::vector<cv::Mat> levels_;
};

}  // namespace orbwatch::align
