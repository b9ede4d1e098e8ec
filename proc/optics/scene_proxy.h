// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "proc/image/result.h"
#include "proc/optics/vec.h"

namespace orbwatch::optics {

/// The mirror ball in the machine frame, millimetres. A ball of unknown size has radius 1: lengths
/// are then in ball radii.
struct Ball {
  Vec3 centre;
  double radius = 1;
};

/// Error: a radius that is not above 0, numbers that are not finite.
inline Result<> check_ball(const Ball& ball) {
  const Vec3& c = ball.centre;
  if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z)) {
    return fail("the ball's centre must be finite numbers");
  }
  if (ball.radius > 0 && std::isfinite(ball.radius)) return {};
  return fail("the ball's radius is " + std::to_string(ball.radius) +
              " mm; it must be above 0 and finite");
}

/// An axis-aligned box, machine frame, mm.
struct Box {
  Vec3 low;
  Vec3 high;
};

/// The known geometry of the machine, as stated by a user. Machine frame, mm.
struct Scene {
  enum class Room { None, Sphere, Plane, Box };
  Room room = Room::None;      ///< None: everything is far away
  Vec3 centre;                 ///< Sphere
  double radius = 0;           ///< Sphere
  Vec3 point;                  ///< Plane: any of its points
  Vec3 normal;                 ///< Plane: any length, either side
  Box walls;                   ///< Box, seen from inside
  std::vector<Box> obstacles;  ///< in any room, seen from outside: table, spindle
};

/// The distance of the scene in every direction from the ball's centre, for parallax. Watertight:
/// every direction meets exactly one surface, on edges and corners too. Reentrant, immutable.
class SceneProxy {
 public:
  /// A scene in which everything is far away.
  SceneProxy() = default;

  /// Error: a ball of radius 0, sizes that are not above 0, a room that does not enclose the ball,
  /// or any part that cuts it; the message names the part.
  static Result<SceneProxy> make(const Scene& scene, const Ball& ball);

  /// The surface in a direction.
  struct Hit {
    double closeness = 0;  ///< ball radius / distance from the ball's centre, in [0, 1]; 0 is far
    int surface = -1;  ///< index of the smooth surface: 0..5 the room, then 6 per obstacle; -1 far
  };
  /// `direction`: unit vector.
  Hit hit(const Vec3& direction) const;

  /// The closeness of one surface, continued smoothly beyond its edges: a face of a box as its
  /// whole plane, below 0 on the plane's far side. Equals hit().closeness where hit() names the
  /// surface.
  double closeness(int surface, const Vec3& direction) const;

  /// The first intersection of a ray from free space with the scene; nullopt when that is far away.
  /// Frame: relative to the ball's centre, in ball radii.
  std::optional<Vec3> meet(const Ray& ray) const;

  bool is_far() const { return room_ == Scene::Room::None && obstacles_.empty(); }

  /// The edges where two surfaces meet or one hides another, as pairs of points relative to the
  /// ball's centre, in ball radii: the boxes' edges, including their silhouettes. Obstacles end at
  /// the walls of a box; their intersections with other rooms or one another are left out.
  std::vector<std::pair<Vec3, Vec3>> edges() const;

  /// A rectangle that contains the surface `surface`: its corner and two sides, relative to the
  /// ball's centre, in ball radii.
  struct Face {
    Vec3 corner;
    Vec3 along;
    Vec3 across;
    int surface = 0;
  };

  /// The faces of boxes that are turned towards the ball: together, the nearer before the further,
  /// they are all that hit() meets. Walls extend slightly beyond their edges, where others hide
  /// them; obstacles end at the walls of a box. A room that is not a box has the faces of a cube
  /// around everything else, which represent directions only.
  std::vector<Face> faces() const;

  /// True if edges() is complete: no plane's horizon, no obstacle in a sphere or before a plane,
  /// and no intersecting obstacles.
  bool lists_every_edge() const;

 private:
  /// A box by axis, with the inverses of its sides' coordinates.
  struct Block {
    Block() = default;
    explicit Block(const Box& box);

    double closeness(int face, const Vec3& direction) const;

    std::array<double, 3> low{};
    std::array<double, 3> high{};
    std::array<double, 3> inverse_low{};
    std::array<double, 3> inverse_high{};
  };

  Result<> set_sphere(const Vec3& centre, double radius);
  Result<> set_plane(const Vec3& point, const Vec3& normal);
  Result<> set_walls(const Box& walls);

  Hit hit_room(const Vec3& direction) const;
  Hit hit_walls(const Vec3& direction) const;
  static Hit hit_obstacle(const Block& box, const Vec3& direction);

  // Distances along the ray; infinite when it does not meet them.
  double meet_room(const Ray& ray) const;
  double meet_walls(const Ray& ray) const;
  static double meet_obstacle(const Block& box, const Ray& ray);

  /// The part of an obstacle within the walls; nullopt when there is none.
  std::optional<Box> within_walls(const Block& obstacle) const;

  // Members are relative to the ball's centre, in ball radii.
  Scene::Room room_ = Scene::Room::None;
  Vec3 centre_;
  double radius_ = 0;
  Vec3 plane_;  ///< the plane satisfies dot(plane_, x) = 1
  Block walls_;
  std::vector<Block> obstacles_;
};

}  // namespace orbwatch::optics
