// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/tracing/ray_bundle.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/app/simulation/random_geometry.h"

namespace orbwatch::app::simulation {
namespace {

const Box kSpace{{-500, -500, -500}, {500, 500, 500}};

/// Rays that start near one point and have similar directions, or any.
std::vector<Ray> some_rays(RandomGeometry& random) {
  const Vec3 origin = random.point(kSpace);
  const Vec3 axis = random.direction();
  const double size = random.number(0, 60);
  const double spread = random.number(0, 1) < 0.2 ? 10 : random.number(0, 0.6);
  std::vector<Ray> rays;
  for (int i = 0; i < 6; ++i) {
    rays.push_back({origin + random.direction() * size,
                    optics::normalized(axis + random.direction() * spread)});
  }
  return rays;
}

TEST(RayBundle, NeverMissesABodyThatOneOfItsRaysMeets) {
  RandomGeometry random;
  for (int i = 0; i < 2000; ++i) {
    const std::vector<Ray> rays = some_rays(random);
    const RayBundle bundle(rays);
    for (const Ray& ray : rays) {
      // The body just touches the ray, on any side of it: the hardest to detect.
      const double radius = random.number(0.1, 60);
      const Vec3 aside = optics::normalized(cross(ray.direction, random.direction()));
      const Vec3 centre = ray.at(random.number(0, 600)) + aside * (radius * 0.999);
      ASSERT_TRUE(bundle.may_meet({centre, radius}));
    }
  }
}

TEST(RayBundle, RefusesMostBodies) {
  RandomGeometry random;
  int refused = 0;
  for (int i = 0; i < 2000; ++i) {
    const RayBundle bundle(some_rays(random));
    refused += bundle.may_meet({random.point(kSpace), random.number(1, 60)}) ? 0 : 1;
  }
  EXPECT_GT(refused, 1000);
}

TEST(RayBundle, RefusesWhatIsAsideOrBehind) {
  const std::vector<Ray> rays{{{0, 0, 0}, normalized(Vec3{0.01, 1, 0})},
                              {{0, 0, 0}, normalized(Vec3{-0.01, 1, 0})}};
  const RayBundle bundle(rays);
  EXPECT_TRUE(bundle.may_meet({{0, 100, 0}, 1}));
  EXPECT_TRUE(bundle.may_meet({{1.9, 100, 0}, 1}));
  EXPECT_FALSE(bundle.may_meet({{3, 100, 0}, 1}));
  EXPECT_FALSE(bundle.may_meet({{20, -100, 0}, 1}));
  EXPECT_FALSE(RayBundle().may_meet({{0, 100, 0}, 1000}));
}

TEST(RayBundle, HoldsASingleRayAndOppositeRays) {
  const std::vector<Ray> one{{{1, 2, 3}, {0, 0, 1}}};
  EXPECT_TRUE(RayBundle(one).may_meet({{1, 2, 50}, 0.001}));
  EXPECT_FALSE(RayBundle(one).may_meet({{1.1, 2, 50}, 0.001}));
  const std::vector<Ray> opposite{{{0, 0, 0}, {0, 0, 1}}, {{0, 0, 0}, {0, 0, -1}}};
  EXPECT_TRUE(RayBundle(opposite).may_meet({{0, 0, 50}, 1}));
  EXPECT_TRUE(RayBundle(opposite).may_meet({{0, 0, -50}, 1}));
}

}  // namespace
}  // namespace orbwatch::app::simulation
