// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "proc/image/picture.h"
#include "proc/remap/grid/tile.h"

namespace orbwatch::remap {

/// A source picture and its mip levels, each half as wide and high as the one before: a view
/// smaller than its source does not alias when it samples the level that fits. Thread-compatible:
/// rows of one level may be filled at the same time, one level after the other.
class Pyramid {
 public:
  /// Allocates memory for `levels` mip levels above the source, 0..kMaxLevel, of pictures of that
  /// format and size. Levels that would be smaller than 2x2 pixels are left out.
  Pyramid(PixelFormat format, int width, int height, int levels);

  /// The highest level; the source is level 0.
  int levels() const { return levels_; }

  /// Sets the picture that the levels are made from; it must outlive their use.
  void set_source(const Picture& source);

  /// Number of pairs of rows of `level`, 1..levels(); pairs, so that subsampled planes have whole
  /// rows.
  int row_pairs(int level) const { return (pictures_[level].height + 1) / 2; }
  /// Fills pairs [first, last) of the rows of `level` with means over 2x2 pixels of the level
  /// below.
  void fill(int level, int first, int last);
  /// Fills all levels.
  void fill();

  /// The pictures, indexed by level.
  std::span<const Picture> pictures() const {
    return {pictures_.data(), static_cast<std::size_t>(levels_) + 1};
  }

 private:
  std::vector<std::byte> memory_;
  int levels_ = 0;
  std::array<Picture, kMaxLevel + 1> pictures_;
  std::array<MutablePicture, kMaxLevel + 1> filled_;  ///< the same pictures, from level 1 on
};

}  // namespace orbwatch::remap
