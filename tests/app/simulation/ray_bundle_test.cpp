#include "app/simulation/ray_bundle.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/app/simulation/random_geometry.h"

namespace orbwatch::app::simulation {
namespace {

const Box kSpace{{-500, -500, -500}, {500, 500, 500}};

/// Distance of a point from a half-line, the plain way.
double distance(const Ray& ray, const Vec3& point) {
  const double along = std::max(0.0, dot(point - ray.origin, ray.direction));
  return norm(point - ray.at(along));
}

TEST(RayBundle, NeverMissesABodyThatOneOfItsRaysMeets) {
  RandomGeometry random;
  int met = 0, refused = 0;
  for (int i = 0; i < 400; ++i) {
    const Vec3 origin = random.point(kSpace);
    const Vec3 axis = random.direction();
    const double spread = random.number(0, 1) < 0.2 ? 10 : random.number(0, 0.6);
    const double size = random.number(0, 20);
    std::vector<Ray> rays;
    for (int j = 0; j < 16; ++j) {
      rays.push_back(
          {origin + random.direction() * size, normalized(axis + random.direction() * spread)});
    }
    const RayBundle bundle(rays);
    for (int j = 0; j < 100; ++j) {
      const Sphere body{random.point(kSpace), random.number(1, 60)};
      bool meets = false;
      for (const Ray& ray : rays) meets = meets || distance(ray, body.centre) <= body.radius;
      ASSERT_TRUE(!meets || bundle.may_meet(body));
      met += meets ? 1 : 0;
      refused += bundle.may_meet(body) ? 0 : 1;
    }
  }
  EXPECT_GT(met, 400);
  EXPECT_GT(refused, 15000);
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
