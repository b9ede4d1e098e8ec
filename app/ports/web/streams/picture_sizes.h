// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace orbwatch::app::web {

/// Sizes in which a view's pictures are sent, the largest first, in quarters of the view's sides. A
/// picture is compressed at most once in each, for all clients together.
inline constexpr std::array kQuarters{4, 3, 2, 1};
inline constexpr std::size_t kFullSize = 0;  ///< place in kQuarters

/// Side in this size of a picture whose full side is given, pixels. Smaller sizes have even sides,
/// which JPEG's halved chroma needs.
constexpr int side_in(std::size_t size, int full) {
  if (size == kFullSize) return full;
  const int side = (kQuarters[size] * full + 3) / 4;
  return std::min(full, side + side % 2);
}

/// The smallest size that is at least `shown` pixels wide; the full one if none is, or for 0.
constexpr std::size_t size_for(int shown, int full_width) {
  std::size_t size = kFullSize;
  if (shown <= 0) return size;
  while (size + 1 < kQuarters.size() && side_in(size + 1, full_width) >= shown) ++size;
  return size;
}

/// Widths of all sizes, the full one first, pixels.
inline std::vector<int> widths_of(int full_width) {
  std::vector<int> widths;
  for (std::size_t size = 0; size < kQuarters.size(); ++size) {
    widths.push_back(side_in(size, full_width));
  }
  return widths;
}

}  // namespace orbwatch::app::web
