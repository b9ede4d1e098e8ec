// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/scene/static_scene.h"

#include <gtest/gtest.h>

#include "tests/app/simulation/projection.h"
#include "tests/app/simulation/random_geometry.h"

namespace orbwatch::app::simulation {
namespace {

TEST(Sight, TakesTheShortestWayOverTheBall) {
  // Fermat: of all points of the ball near the one hit, the reflected path is the shortest.
  RandomGeometry random;
  const Pinhole camera = look_at({160, -430, 480}, kMachine.ball.centre, 13, 1000, 1000);
  int reflected = 0;
  while (reflected < 500) {
    const Ray ray = camera.ray_through(random.number(0, 999), random.number(0, 999));
    const Sight sight = sight_along(ray, kMachine.ball);
    if (!sight.on_ball()) continue;
    ++reflected;
    const Vec3 centre = kMachine.ball.centre;
    const Vec3 hit = ray.at(sight.ball_distance);
    ASSERT_NEAR(norm(hit - centre), kMachine.ball.radius, 1e-9);
    const Vec3 end = sight.mirrored.at(400);
    const auto path = [&](const Vec3& over) {
      return norm(over - camera.position) + norm(end - over);
    };
    for (int i = 0; i < 4; ++i) {
      constexpr double kStep = 0.05;  // mm
      const Vec3 side = normalized(cross(hit - centre, random.direction())) * kStep;
      const Vec3 there = centre + normalized(hit + side - centre) * kMachine.ball.radius;
      const Vec3 opposite = centre + normalized(hit - side - centre) * kMachine.ball.radius;
      ASSERT_GT(path(there), path(hit));
      ASSERT_NEAR((path(there) - path(opposite)) / (2 * kStep), 0, 1e-4) << "slope";
    }
  }
}

TEST(Sight, LeavesTheBallOnTheSideOfItsNormalOnly) {
  const Sight past = sight_along({{120, -400, 481}, {0, 1, 0}}, kMachine.ball);
  EXPECT_FALSE(past.on_ball());
  const Sight behind = sight_along({{120, 400, 430}, {0, 1, 0}}, kMachine.ball);
  EXPECT_FALSE(behind.on_ball());
  const Sight middle = sight_along({{120, -400, 430}, {0, 1, 0}}, kMachine.ball);
  EXPECT_NEAR(middle.ball_distance, 410, 1e-9);
  EXPECT_NEAR(middle.mirrored.direction.y, -1, 1e-12);
}

bool free_space(const Vec3& p) {
  return kMachine.enclosure.contains(p) && !kMachine.table.contains(p) &&
         !kMachine.workpiece.contains(p);
}

/// Distance of a point from the plane of its reported surface.
double distance_from(Surface surface, const Vec3& p, const Vec3& normal) {
  const auto of_body = [&](const Box& body) {
    const Vec3 face{normal.x > 0 ? body.hi.x : body.lo.x, normal.y > 0 ? body.hi.y : body.lo.y,
                    normal.z > 0 ? body.hi.z : body.lo.z};
    return std::abs(dot(p - face, normal));
  };
  const Box& box = kMachine.enclosure;
  switch (surface) {
    case Surface::Left:
      return std::abs(p.x - box.lo.x);
    case Surface::Right:
      return std::abs(p.x - box.hi.x);
    case Surface::Front:
      return std::abs(p.y - box.lo.y);
    case Surface::Back:
      return std::abs(p.y - box.hi.y);
    case Surface::Floor:
      return std::abs(p.z - box.lo.z);
    case Surface::Ceiling:
      return std::abs(p.z - box.hi.z);
    case Surface::Table:
      return of_body(kMachine.table);
    case Surface::Workpiece:
      return of_body(kMachine.workpiece);
    case Surface::Outside:
      break;
  }
  return kNever;
}

TEST(StaticScene, HitsLieOnTheSurfaceTheyNameAndNothingStandsBefore) {
  RandomGeometry random;
  std::array<int, 9> seen{};
  for (int i = 0; i < 4000;) {
    const Ray ray = random.ray(kMachine.enclosure);
    if (!free_space(ray.origin)) continue;
    ++i;
    const StaticHit hit = nearest_static(kMachine, ray);
    ++seen[static_cast<std::size_t>(hit.surface)];
    ASSERT_LT(distance_from(hit.surface, ray.at(hit.distance), hit.normal), 1e-9);
    ASSERT_LT(dot(hit.normal, ray.direction), 0);
    ASSERT_NEAR(norm(hit.normal), 1, 1e-12);
    for (int step = 0; step < 200; ++step) {
      ASSERT_TRUE(free_space(ray.at(hit.distance * (step + 0.5) / 200.5)));
    }
    ASSERT_FALSE(free_space(ray.at(hit.distance + 1e-6)));
  }
  for (std::size_t surface = 0; surface < 8; ++surface) EXPECT_GT(seen[surface], 20) << surface;
  EXPECT_EQ(seen[8], 0);
}

TEST(StaticScene, WallsAreWindowsFromOutside) {
  const StaticHit through = nearest_static(kMachine, {{0, -900, 600}, {0, 1, 0}});
  EXPECT_EQ(through.surface, Surface::Back);
  EXPECT_NEAR(through.distance, 1400, 1e-9);
  const StaticHit past = nearest_static(kMachine, {{0, -900, 900}, {0, 1, 0}});
  EXPECT_EQ(past.surface, Surface::Outside);
  EXPECT_EQ(past.distance, kNever);
}

TEST(StaticScene, ATableHidesTheBall) {
  // The ray leads from below the table straight to the ball.
  const Vec3 eye{120, 60, 50};
  const Sight sight = sight_along({eye, {0, 0, 1}}, kMachine.ball);
  ASSERT_TRUE(sight.on_ball());
  EXPECT_NEAR(obstacle_distance(kMachine, sight.direct), 50, 1e-9);
  EXPECT_EQ(static_end(kMachine, sight).hit.surface, Surface::Table);
  EXPECT_NEAR(static_end(kMachine, sight).hit.distance, 50, 1e-9);
}

TEST(StaticScene, ASightOnTheBallEndsWhereItsReflectionDoes) {
  const Sight sight = sight_along({{120, -400, 430}, {0, 1, 0}}, kMachine.ball);
  const StaticEnd end = static_end(kMachine, sight);
  EXPECT_EQ(end.hit.surface, Surface::Front);
  EXPECT_NEAR(end.ray.at(end.hit.distance).y, -500, 1e-9);
}

}  // namespace
}  // namespace orbwatch::app::simulation
