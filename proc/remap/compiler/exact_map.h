// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "proc/optics/ball_projection.h"
#include "proc/optics/lanes.h"
#include "proc/optics/view_projection.h"
#include "proc/remap/grid/coordinate.h"

namespace orbwatch::remap {

/// kLanes coordinates by component.
struct CoordinateLanes {
  std::array<std::int32_t, optics::kLanes> u;
  std::array<std::int32_t, optics::kLanes> v;

  Coordinate at(std::size_t k) const { return {u[k], v[k]}; }
};

/// The optical map that a grid approximates. Reentrant; refers to the view and the ball.
class ExactMap {
 public:
  ExactMap(const optics::ViewProjection& view, const optics::BallProjection& ball)
      : view_(view), ball_(ball) {}

  /// Surface of a pixel beyond the end of the view's projection.
  static constexpr int kNoSurface = -2;

  struct MapLanes {
    std::array<int, optics::kLanes> surfaces;  ///< indices of SceneProxy
    CoordinateLanes coordinates;
  };
  /// Evaluates kLanes pixels, also outside of the view.
  void evaluate(const optics::Vec2Lanes& pixels, MapLanes& out) const;

  /// The surface only, at pixel (x, y).
  int surface(int x, int y) const;

  /// The coordinate at (x, y) under the assumption that this surface is seen there. Smooth on each
  /// surface.
  Coordinate on_surface(int surface, int x, int y) const;
  /// The same for kLanes pixels, each on its surface in `lanes`.
  void on_surfaces(const optics::Vec2Lanes& pixels, MapLanes& lanes) const;

 private:
  Coordinate coordinate(const optics::Vec3& direction, double closeness) const;
  void coordinates(const optics::Vec3Lanes& directions, const optics::Lanes& closeness,
                   CoordinateLanes& out) const;

  const optics::ViewProjection& view_;
  const optics::BallProjection& ball_;
};

/// Pixels of a view in rows and columns at equal distances.
struct Lattice {
  int x, y;  ///< the first one
  int step;
  int columns, rows;
};

/// Iterates over a lattice row by row: `evaluate(pixels, first)` once for up to kLanes pixels, the
/// first of which has the number `first`, then `visit(i, j, k)` for each: column, row, lane.
template <class Evaluate, class Visit>
void in_lanes(const Lattice& lattice, const Evaluate& evaluate, const Visit& visit) {
  optics::Vec2Lanes pixels{};
  const auto count =
      static_cast<std::size_t>(lattice.columns) * static_cast<std::size_t>(lattice.rows);
  int i = 0, j = 0, asked_i = 0, asked_j = 0;
  const auto next = [&](int& column, int& row) {
    if (++column < lattice.columns) return;
    column = 0;
    ++row;
  };
  for (std::size_t first = 0; first < count; first += optics::kLanes) {
    const std::size_t lanes = std::min(optics::kLanes, count - first);
    for (std::size_t k = 0; k < lanes; ++k, next(asked_i, asked_j)) {
      pixels.u[k] = lattice.x + asked_i * lattice.step;
      pixels.v[k] = lattice.y + asked_j * lattice.step;
    }
    evaluate(pixels, first);
    for (std::size_t k = 0; k < lanes; ++k, next(i, j)) visit(i, j, k);
  }
}

}  // namespace orbwatch::remap
