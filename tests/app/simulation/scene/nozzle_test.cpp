// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/scene/nozzle.h"

#include <gtest/gtest.h>

#include "tests/app/simulation/random_geometry.h"

namespace orbwatch::app::simulation {
namespace {

const NozzleSettings kShape;
const Vec3 kTip{-110, -50, 193};
constexpr double kCeiling = 800;
const Box kAroundNozzle{{-300, -250, 100}, {100, 150, 799}};

bool inside(const Vec3& p) {
  const double height = p.z - kTip.z;
  if (height < 0 || p.z > kCeiling) return false;
  const double share = std::min(height / kShape.cone_height, 1.0);
  const double radius = kShape.tip_radius + share * (kShape.column_radius - kShape.tip_radius);
  return std::hypot(p.x - kTip.x, p.y - kTip.y) < radius;
}

TEST(Nozzle, IsEnteredWhereItBegins) {
  RandomGeometry random;
  const Nozzle nozzle(kShape, kTip, kCeiling);
  int entered = 0, passed = 0;
  for (int i = 0; i < 5000; ++i) {
    // Half of the rays aim at the cone.
    Ray ray = random.ray(kAroundNozzle);
    if (i % 2 == 0) {
      const Vec3 aim =
          kTip + Vec3{random.number(-20, 20), random.number(-20, 20), random.number(-10, 80)};
      ray.direction = normalized(aim - ray.origin);
    }
    if (inside(ray.origin)) continue;
    const double distance = nozzle.entry(ray);
    const double end = std::min(distance, 600.0);
    for (double s = 0.25; s < end - 1e-6; s += 0.5) {
      ASSERT_FALSE(inside(ray.at(s)) && ray.at(s).z < kCeiling) << "solid before the entry";
    }
    if (distance == kNever) {
      ++passed;
      continue;
    }
    ++entered;
    const Vec3 normal = nozzle.normal_at(ray.at(distance));
    ASSERT_NEAR(norm(normal), 1, 1e-9);
    ASSERT_LE(dot(normal, ray.direction), 1e-9);
    ASSERT_FALSE(inside(ray.at(distance) + normal * 1e-6));
    ASSERT_TRUE(inside(ray.at(distance) - normal * 1e-6));
  }
  EXPECT_GT(entered, 500);
  EXPECT_GT(passed, 500);
}

TEST(Nozzle, IsEnteredThroughItsTipFromBelow) {
  const Nozzle nozzle(kShape, kTip, kCeiling);
  EXPECT_NEAR(nozzle.entry({{-108, -50, 178}, {0, 0, 1}}), 15, 1e-9);
  EXPECT_NEAR(nozzle.normal_at({-108, -50, 193}).z, -1, 1e-12);
  EXPECT_TRUE(nozzle.is_cone({-108, -50, 193}));
  EXPECT_FALSE(nozzle.is_cone({-85, -50, 400}));
}

TEST(Nozzle, LiesWithinItsBounds) {
  RandomGeometry random;
  const Nozzle nozzle(kShape, kTip, kCeiling);
  const Box around{{kTip.x - 25, kTip.y - 25, kTip.z}, {kTip.x + 25, kTip.y + 25, kCeiling}};
  for (int i = 0; i < 5000; ++i) {
    const Vec3 p = random.point(around);
    if (!inside(p)) continue;
    bool held = false;
    for (const Sphere& part : nozzle.bounds()) held = held || norm(p - part.centre) <= part.radius;
    ASSERT_TRUE(held);
  }
}

}  // namespace
}  // namespace orbwatch::app::simulation
