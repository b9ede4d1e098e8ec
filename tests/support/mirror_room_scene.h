// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <random>
#include <vector>

#include "app/simulation/tracing/ray.h"
#include "proc/optics/scene_proxy.h"
#include "proc/optics/vec.h"
#include "tests/support/mirror_room.h"

namespace orbwatch::tests {

/// The random room of mirror_room() with everything in it, but the camera. Thread-bound.
class MirrorRoomScene {
 public:
  using Ray = app::simulation::Ray;
  using Vec3 = optics::Vec3;
  /// Linear light; a thermal camera uses the first component.
  using Light = Vec3;

  explicit MirrorRoomScene(const MirrorRoomSettings& settings);

  /// Adds the rod that the ball hangs on, along `axis`, a unit vector.
  void hang(const Vec3& axis, double radius);

  /// Removes everything that hides the ball from a point, except the rod.
  void clear_sight(const Vec3& from);

  /// Switches to temperatures.
  void warm();

  /// nullopt: there is no table, or it was removed because it hid the ball.
  std::optional<optics::Box> table() const;

  /// The walls and boxes.
  optics::Scene scene() const;

  /// The point where a ray reflected by the ball ends.
  std::optional<Vec3> mirrored(const Ray& ray) const;

  /// The light that arrives along a ray from outside of everything.
  Light light(const Ray& ray) const;

 private:
  using Vec2 = optics::Vec2;
  using Box = app::simulation::Box;
  using Sphere = app::simulation::Sphere;

  /// Appearance of a surface: patches of random colours, stripes and stains.
  struct Paint {
    std::uint64_t seed = 0;
    Light base;
    double patch = 1;     ///< side of the patches' squares
    double strength = 0;  ///< contrast of patches
    double stripes = 0;   ///< period; 0: none
    double stains = 0;    ///< amplitude of smooth noise
    bool warm = false;    ///< appearance by temperature: the same shapes, other values

    /// The same surface's appearance to a thermal camera.
    Paint warmed() const;
    /// Light from a place on the surface.
    Light at(double x, double y) const;
  };

  /// A solid tube from `foot` along `axis`.
  struct Tube {
    Vec3 foot;
    Vec3 axis;  ///< unit vector
    double radius = 0;
    double length = 0;
    Paint paint;
  };

  struct Block {
    Box box;
    std::array<Paint, 3> paints;  ///< one per axis
  };

  struct Marble {
    Sphere sphere;
    Paint paint;
  };

  /// The end of a ray.
  struct End {
    double distance = app::simulation::kNever;
    Light light;
  };

  struct Lamp {
    Vec2 centre;
    Vec2 half;
    double light;
  };

  /// Adds a table with a seed of its own, so that everything else is the same as without it.
  void stand_table(std::uint64_t seed);
  double in(double low, double high);
  Vec3 away_from_ball();
  Paint a_paint(double size);
  /// kNever: the ray does not meet the tube from outside.
  static double distance_to(const Tube& tube, const Ray& ray);
  /// The first surface other than the ball's.
  End end(const Ray& ray) const;
  static void take_tube(const Ray& ray, const Tube& tube, End& nearest);

  std::mt19937_64 random_;
  Box room_;
  std::array<std::array<Paint, 3>, 2> walls_;  ///< low and high sides, for each axis
  std::vector<Block> blocks_;
  std::vector<Tube> tubes_;
  std::vector<Marble> marbles_;
  std::vector<Lamp> lamps_;
  std::optional<Sphere> ball_;
  std::optional<Box> table_;
  std::optional<Tube> rod_;
  Light reflectance_;
  double grain_ = 0;  ///< share of light that the ball scatters
};

}  // namespace orbwatch::tests
