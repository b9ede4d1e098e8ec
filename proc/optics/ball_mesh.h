// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "proc/optics/vec.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::optics {

/// One camera's view of the ball as triangles that a graphics processor draws as seen from the
/// ball's centre, the nearer before the further. The pixel of the Ball view that shows a point is
///   centre + (u . h, v . h) + offset,  h = the unit vector half way from `facing` to the point,
/// where only the offset is interpolated. The first terms are a distant ball's picture; they leave
/// an offset that bends little, so that few nodes are as exact as many.
struct BallMesh {
  struct Node {
    Vec3 position;      ///< from the ball's centre, machine frame, ball radii
    Vec2 offset;        ///< pixels
    double resolution;  ///< the camera's pixels per degree: see optics::resolution(); 0: blind
  };
  Vec3 facing;  ///< from the ball's centre towards the camera
  Vec2 centre;  ///< the pixel that shows this direction
  Vec3 u;       ///< pixels per half-way vector
  Vec3 v;
  std::vector<Node> nodes;
  std::vector<std::uint32_t> triangles;  ///< three nodes each
  /// The same in the blind cone: they hide everything behind them.
  std::vector<std::uint32_t> blind;

  /// The pixel without the offset.
  Vec2 distant(const Vec3& position) const {
    const Vec3 half_way = normalized(normalized(position) + facing);
    return {centre.u + dot(u, half_way), centre.v + dot(v, half_way)};
  }
};

/// Builds the mesh, exact to 1/32 px except at the blind cone, which begins up to 1/4 degree early.
/// Triangles lie on the scene's faces, including parts that another face hides. `view`: of kind
/// Ball. Empty: the ball is not seen, as through a window that stands edge-on.
BallMesh ball_mesh(const ViewProjection& view);

}  // namespace orbwatch::optics
