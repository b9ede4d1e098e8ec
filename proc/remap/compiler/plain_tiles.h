// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "proc/optics/lanes.h"
#include "proc/remap/grid/coordinate.h"

namespace orbwatch::remap {

/// Finds plain tiles, which most are, in vector code: all nodes around them are on one surface, the
/// patch between them is within the tolerance with certainty, and it is interior.
class PlainTiles {
 public:
  /// For a source of that size.
  PlainTiles(int tiles_x, int tiles_y, int source_width, int source_height);

  /// Sets a node of the grid, (-1, -1) to (tiles_x + 1, tiles_y + 1). Undefined ones have no
  /// surface.
  void set_node(int i, int j, const Coordinate& node, int surface) {
    const std::size_t at = index(i, j);
    u_[at] = node.u;
    v_[at] = node.v;
    surfaces_[at] = is_defined(node) ? surface : kUndefined;
  }
  /// Completes the planes after the last node.
  void finish();

  static constexpr std::size_t kRun = optics::kLanes;
  static constexpr std::int32_t kNotPlain = -1;
  using Levels = std::array<std::int32_t, kRun>;
  /// The mip levels of the kRun tiles from (tx, ty) on; kNotPlain for those that are not plain.
  void classify(int tx, int ty, Levels& levels) const;

 private:
  static constexpr std::int32_t kUndefined = INT32_MIN;

  std::size_t index(int i, int j) const {
    return static_cast<std::size_t>(j + 2) * stride_ + static_cast<std::size_t>(i + 2);
  }
  void extrapolate(std::vector<std::int32_t>& plane) const;

  int tiles_x_;
  int tiles_y_;
  float width_;
  float height_;
  /// Distance between rows of nodes: includes one node before the first, and enough behind the last
  /// that a run of tiles may end beyond it.
  std::size_t stride_;
  std::vector<std::int32_t> u_;
  std::vector<std::int32_t> v_;
  std::vector<std::int32_t> surfaces_;
};

}  // namespace orbwatch::remap
