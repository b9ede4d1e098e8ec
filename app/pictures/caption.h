// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "proc/image/image_view.h"

namespace orbwatch::app {

/// Lines of text below a picture, in columns: as many as its width has room for, or more if the
/// lines would be higher than a screen. Reentrant.
class Caption {
 public:
  /// Characters of a line; more are cut.
  static constexpr std::size_t kMostLength = 56;

  /// For pictures of this width, and at most this number of lines.
  Caption(int picture_width, std::size_t lines);

  /// Sides, px; the caption may be wider than the picture.
  int width() const { return width_; }
  int height() const;

  /// Writes white text on black into `target`, 8 bit with the caption's sides. Characters other
  /// than ASCII become '?'; lines without room are left out.
  void draw(const std::vector<std::string>& lines, const ImageView<std::uint8_t>& target) const;

 private:
  int width_;
  std::size_t rows_;
};

}  // namespace orbwatch::app
