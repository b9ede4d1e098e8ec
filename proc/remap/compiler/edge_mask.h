// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "proc/optics/vec.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::remap {

/// Places of a scene's edges in a view. Conservative: a marked place may be without an edge.
class EdgeMask {
 public:
  /// For a view of that size; nothing is marked.
  EdgeMask(int width, int height);

  /// Marks the pixels separated by an edge along the straight line between two places of the view,
  /// or a twentieth of a pixel beside it.
  void mark(const optics::Vec2& from, const optics::Vec2& to);

  /// True if an edge runs between two pixels of that tile.
  bool crosses(int tx, int ty) const { return !crossed_.empty() && crossed_[tile(tx, ty)] != 0; }

  /// Row `y` of the view within tile column `tx`: bit x is set if an edge runs between pixels x - 1
  /// and x.
  std::uint16_t row(int tx, int y) const {
    if (rows_.empty()) return 0;
    return rows_[static_cast<std::size_t>(y) * tiles_x_ + tx];
  }

 private:
  void mark_row(int y, double left, double right);
  void mark_column(int x, double top, double bottom);
  std::size_t tile(int tx, int ty) const { return static_cast<std::size_t>(ty) * tiles_x_ + tx; }

  int width_;
  int height_;
  int tiles_x_;
  // Empty until something is marked.
  std::vector<std::uint16_t> rows_;
  std::vector<std::uint8_t> crossed_;
};

/// Marks edges, pairs of points in the reference frame relative to the ball's centre, as straight
/// lines in space. Reentrant.
EdgeMask edge_mask(const optics::ViewProjection& view,
                   const std::vector<std::pair<optics::Vec3, optics::Vec3>>& edges);

}  // namespace orbwatch::remap
