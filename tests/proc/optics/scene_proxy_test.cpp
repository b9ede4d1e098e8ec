// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/scene_proxy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "tests/proc/optics/random_camera.h"

namespace orbwatch::optics {
namespace {

using testing::HasSubstr;
using tests::kBall;
using tests::kInfinity;
using tests::random_direction;

const Box kWalls{{-500, -400, -100}, {600, 500, 800}};
const Box kTable{{-300, -200, -100}, {400, 300, 200}};
const Box kSpindle{{200, 50, 300}, {280, 130, 900}};  // sticks out of the room

Scene box_scene(std::vector<Box> obstacles = {}) {
  Scene scene;
  scene.room = Scene::Room::Box;
  scene.walls = kWalls;
  scene.obstacles = std::move(obstacles);
  return scene;
}

SceneProxy made(const Scene& scene) { return SceneProxy::make(scene, kBall).value(); }

Vec3 relative(const Vec3& point) { return (point - kBall.centre) * (1 / kBall.radius); }

double component(const Vec3& v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

/// Distance along a ray to the nearest of a box's faces that are turned away from the ray or
/// towards it, each face a plane of its own. Ball radii.
double way_to_faces(const Box& box, const Ray& ray, bool from_inside) {
  const Vec3 low = relative(box.low), high = relative(box.high);
  double nearest = kInfinity;
  for (int axis = 0; axis < 3; ++axis) {
    for (const bool upper : {false, true}) {
      const double speed = component(ray.direction, axis);
      const bool leaving = (speed > 0) == upper;
      const double side = component(upper ? high : low, axis);
      const double way = (side - component(ray.origin, axis)) / speed;
      if (!(way > 0) || leaving != from_inside) continue;
      const Vec3 at = ray.origin + ray.direction * way;
      bool within = true;
      for (int other = 0; other < 3; ++other) {
        if (other == axis) continue;
        within = within && component(at, other) >= component(low, other) - 1e-9 &&
                 component(at, other) <= component(high, other) + 1e-9;
      }
      if (within) nearest = std::min(nearest, way);
    }
  }
  return nearest;
}

double reference_way(const Ray& ray, const std::vector<Box>& obstacles) {
  double way = way_to_faces(kWalls, ray, true);
  for (const Box& box : obstacles) way = std::min(way, way_to_faces(box, ray, false));
  return way;
}

TEST(SceneProxy, HitAndMeetAreTheNearestFace) {
  std::mt19937 random(31);
  const std::vector<Box> obstacles{kTable, kSpindle};
  const SceneProxy proxy = made(box_scene(obstacles));
  int on_obstacles = 0;
  for (int i = 0; i < 5000; ++i) {
    const Vec3 v = random_direction(random);
    const SceneProxy::Hit hit = proxy.hit(v);
    EXPECT_NEAR(hit.closeness * reference_way({{}, v}, obstacles), 1, 1e-9);
    EXPECT_EQ(proxy.closeness(hit.surface, v), hit.closeness);
    on_obstacles += hit.surface >= 6;
    Ray ray{random_direction(random), v};
    if (dot(ray.origin, v) < 0) ray.direction = -v;
    const Vec3 point = proxy.meet(ray).value();
    EXPECT_NEAR(norm(point - ray.origin) / reference_way(ray, obstacles), 1, 1e-9);
  }
  EXPECT_GT(on_obstacles, 500);
}

TEST(SceneProxy, SurfacesAreNumberedByFace) {
  const SceneProxy proxy = made(box_scene({kTable, kSpindle}));
  const auto towards = [&](const Vec3& point) {
    return proxy.hit(normalized(point - kBall.centre)).surface;
  };
  EXPECT_EQ(towards({-500, 0, 400}), 0);
  EXPECT_EQ(towards({600, -300, 400}), 1);
  EXPECT_EQ(towards({0, -400, 400}), 2);
  EXPECT_EQ(towards({0, 500, 400}), 3);
  EXPECT_EQ(towards({0, 0, 800}), 5);
  EXPECT_EQ(towards({120, 0, 200}), 6 + 5);    // the table's top
  EXPECT_EQ(towards({200, 90, 500}), 12 + 0);  // the spindle's left side
  EXPECT_EQ(SceneProxy().hit({0, 1, 0}).surface, -1);
}

TEST(SceneProxy, SphereIsMetOnItsSurface) {
  std::mt19937 random(32);
  Scene scene;
  scene.room = Scene::Room::Sphere;
  scene.centre = {400, 200, 100};
  scene.radius = 600;
  const SceneProxy proxy = made(scene);
  const Vec3 centre = relative(scene.centre);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 v = random_direction(random), origin = random_direction(random);
    const SceneProxy::Hit hit = proxy.hit(v);
    EXPECT_EQ(hit.surface, 0);
    EXPECT_GT(hit.closeness, 0);
    EXPECT_NEAR(norm(v * (1 / hit.closeness) - centre), scene.radius / kBall.radius, 1e-11);
    const Vec3 point = proxy.meet({origin, v}).value();
    EXPECT_NEAR(norm(point - centre), scene.radius / kBall.radius, 1e-11);
    EXPECT_GT(dot(point - origin, v), 0);
  }
}

TEST(SceneProxy, PlaneIsFarWhereItIsNotMet) {
  std::mt19937 random(33);
  Scene scene;
  scene.room = Scene::Room::Plane;
  scene.point = {300, 100, -200};
  for (const Vec3& normal : {Vec3{0.2, 0.1, 5}, Vec3{-0.2, -0.1, -5}}) {  // either side
    scene.normal = normal;
    const SceneProxy proxy = made(scene);
    const Vec3 down = normalized({-0.2, -0.1, -5});
    const double offset = dot(relative(scene.point), down);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 v = random_direction(random), origin = random_direction(random);
      const SceneProxy::Hit hit = proxy.hit(v);
      EXPECT_NEAR(hit.closeness, std::max(0.0, dot(v, down)) / offset, 1e-15);
      EXPECT_EQ(hit.surface, dot(v, down) > 0 ? 0 : -1);
      EXPECT_NEAR(proxy.closeness(0, v), dot(v, down) / offset, 1e-15);
      const auto point = proxy.meet({origin, v});
      ASSERT_EQ(point.has_value(), dot(v, down) > 0);
      if (point) {
        EXPECT_NEAR(dot(*point, down) / offset, 1, 1e-9);
      }
    }
  }
}

TEST(SceneProxy, FarAwayWithoutGeometry) {
  EXPECT_TRUE(SceneProxy().is_far());
  EXPECT_EQ(SceneProxy().hit({0, 1, 0}).closeness, 0);
  EXPECT_FALSE(SceneProxy().meet({{0, 1, 0}, {0, 1, 0}}));
  EXPECT_TRUE(SceneProxy().edges().empty());
  Scene only_table;
  only_table.obstacles = {kTable};
  EXPECT_FALSE(made(only_table).is_far());
  EXPECT_GT(made(only_table).hit({0, 0, -1}).closeness, 0);
  EXPECT_EQ(made(only_table).hit({0, 0, 1}).surface, -1);
}

TEST(SceneProxy, AnObstacleReachesToItsSides) {
  // Its sides begin exactly below the ball's centre.
  const Box aligned{{kBall.centre.x, kBall.centre.y, -100}, {400, 300, 200}};
  const SceneProxy proxy = made(box_scene({aligned}));
  EXPECT_EQ(proxy.hit({0, 0, -1}).surface, 6 + 5);
  EXPECT_NEAR(proxy.hit({0, 0, -1}).closeness, 50 / 110., 1e-15);
  EXPECT_NEAR(norm(proxy.meet({{0, 0, -1}, {0, 0, -1}}).value()), 110 / 50., 1e-15);
  EXPECT_EQ(proxy.hit(normalized({-1e-9, 0, -1})).surface, 4);
}

/// Directions that are difficult for slab tests: along axes, to corners and to points of edges.
std::vector<Vec3> awkward_directions(const SceneProxy& proxy) {
  std::vector<Vec3> directions;
  for (const double x : {-1.0, 0.0, -0.0, 1.0}) {
    for (const double y : {-1.0, 0.0, -0.0, 1.0, 1e-300}) {
      for (const double z : {-1.0, 0.0, -0.0, 1.0, -1e-320}) {
        if (std::hypot(x, y, z) > 0.5) directions.push_back(normalized({x, y, z}));
      }
    }
  }
  for (const auto& [from, to] : proxy.edges()) {
    for (const double share : {0.0, 0.25, 1 / 3., 0.5, 0.9, 1.0}) {
      directions.push_back(normalized(from + (to - from) * share));
    }
  }
  return directions;
}

TEST(SceneProxy, IsWatertight) {
  std::mt19937 random(34);
  Scene symmetric = box_scene();  // edges and corners lie exactly on the axes' diagonals
  symmetric.walls = {kBall.centre - Vec3{300, 300, 300}, kBall.centre + Vec3{300, 300, 300}};
  for (const Scene& scene : {symmetric, box_scene({kTable, kSpindle})}) {
    const SceneProxy proxy = made(scene);
    int leaks = 0, differences = 0;
    const auto look = [&](const Vec3& v) {
      const SceneProxy::Hit hit = proxy.hit(v);
      const auto point = proxy.meet({v, v});
      leaks += !(hit.closeness > 0 && hit.closeness < 1 && hit.surface >= 0) || !point;
      differences += point && !(std::abs(norm(*point) * hit.closeness - 1) < 1e-9);
    };
    for (int i = 0; i < 100000; ++i) look(random_direction(random));
    EXPECT_EQ(differences, 0);
    // Rounding may choose either surface exactly on an edge that hides another surface.
    for (const Vec3& v : awkward_directions(proxy)) look(v);
    EXPECT_EQ(leaks, 0);
    if (scene.obstacles.empty()) {
      EXPECT_EQ(differences, 0);
    }
  }
}

TEST(SceneProxy, ClosenessIsContinuousAcrossTheRoomsEdges) {
  const SceneProxy proxy = made(box_scene());
  for (const auto& [from, to] : proxy.edges()) {
    const Vec3 middle = from + (to - from) * 0.4;
    const Vec3 v = normalized(middle), across = normalized(cross(v, to - from));
    const auto before = proxy.hit(normalized(v - across * 1e-9));
    const auto after = proxy.hit(normalized(v + across * 1e-9));
    EXPECT_NE(before.surface, after.surface);
    EXPECT_NEAR(before.closeness, after.closeness, 1e-8);
    EXPECT_NEAR(proxy.hit(v).closeness * norm(middle), 1, 1e-12);
  }
}

TEST(SceneProxy, EdgesAreThoseOfBoxesWithinTheWalls) {
  EXPECT_EQ(made(box_scene()).edges().size(), 12U);
  const auto edges = made(box_scene({kTable, kSpindle})).edges();
  // The table has its top turned towards the ball, the spindle two sides that share an edge.
  EXPECT_EQ(edges.size(), 12U + 4U + 7U);
  double highest = 0;
  for (const auto& [from, to] : edges) {
    const Vec3 along = to - from;  // along one axis, towards its positive end
    EXPECT_NEAR(norm(along), along.x + along.y + along.z, 1e-12);
    EXPECT_GT(norm(along), 0);
    highest = std::max(highest, to.z);
  }
  EXPECT_NEAR(highest, relative(kWalls.high).z, 1e-12);  // the spindle ends at the ceiling
  const Box beyond{{700, 0, 0}, {800, 10, 10}};
  EXPECT_EQ(made(box_scene({beyond})).edges().size(), 12U);
}

TEST(SceneProxy, KnowsWhetherItListsEveryEdge) {
  EXPECT_TRUE(SceneProxy().lists_every_edge());
  EXPECT_TRUE(made(box_scene({kTable, kSpindle})).lists_every_edge());
  const Box through_table{{0, 0, 150}, {50, 50, 210}};
  EXPECT_FALSE(made(box_scene({kTable, through_table})).lists_every_edge());
  EXPECT_TRUE(tests::scene_around_ball(Scene::Room::Sphere, false).lists_every_edge());
  EXPECT_FALSE(tests::scene_around_ball(Scene::Room::Sphere, true).lists_every_edge());
  EXPECT_FALSE(tests::scene_around_ball(Scene::Room::Plane, false).lists_every_edge());
}

std::string reason(const Scene& scene, const Ball& ball = kBall) {
  const auto proxy = SceneProxy::make(scene, ball);
  return proxy ? "" : proxy.error().message;
}

TEST(SceneProxy, RefusesWhatCutsOrDoesNotEncloseTheBall) {
  Scene sphere;
  sphere.room = Scene::Room::Sphere;
  sphere.centre = kBall.centre + Vec3{100, 0, 0};
  sphere.radius = 150.001;
  EXPECT_EQ(reason(sphere), "");
  sphere.radius = 149.999;
  EXPECT_THAT(reason(sphere), HasSubstr("sphere cuts the ball"));
  sphere.radius = 49;
  EXPECT_THAT(reason(sphere), HasSubstr("sphere does not enclose the ball"));
  Scene plane;
  plane.room = Scene::Room::Plane;
  plane.normal = {0, 0, 1};
  plane.point = kBall.centre - Vec3{0, 0, 49.9};
  EXPECT_THAT(reason(plane), HasSubstr("plane cuts the ball"));
  plane.point = kBall.centre;
  EXPECT_THAT(reason(plane), HasSubstr("plane cuts the ball"));
  Scene box = box_scene();
  box.walls.low.z = kBall.centre.z - 49.9;
  EXPECT_THAT(reason(box), HasSubstr("box cuts the ball"));
  box.walls.low.z = kBall.centre.z + 60;
  EXPECT_THAT(reason(box), HasSubstr("box does not enclose the ball"));
  const Box big{kBall.centre - Vec3{60, 60, 60}, kBall.centre + Vec3{60, 60, 60}};
  EXPECT_THAT(reason(box_scene({kTable, big})), HasSubstr("obstacle 2 contains the ball"));
  const Box touching{kBall.centre + Vec3{49, -5, -5}, kBall.centre + Vec3{99, 5, 5}};
  EXPECT_THAT(reason(box_scene({touching})), HasSubstr("obstacle 1 cuts the ball"));
}

TEST(SceneProxy, RefusesImpossibleNumbers) {
  const double nan = std::nan("");
  EXPECT_THAT(reason(box_scene(), {kBall.centre, 0}), HasSubstr("above 0"));
  EXPECT_THAT(reason(box_scene(), {kBall.centre, nan}), HasSubstr("above 0"));
  EXPECT_THAT(reason(box_scene(), {{nan, 0, 0}, 50}), HasSubstr("finite"));
  Scene box = box_scene();
  std::swap(box.walls.low.y, box.walls.high.y);
  EXPECT_THAT(reason(box), HasSubstr("low must be below high"));
  EXPECT_THAT(reason(box_scene({{{0, 0, 0}, {1, 1, 0}}})), HasSubstr("low must be below high"));
  for (const double bad : {nan, kInfinity, 1e300}) {
    box = box_scene();
    box.walls.high.x = bad;
    EXPECT_THAT(reason(box), HasSubstr("finite")) << bad;
    EXPECT_THAT(reason(box_scene({{{bad, 0, 0}, {1, 1, 1}}})), HasSubstr("finite")) << bad;
    Scene sphere;
    sphere.room = Scene::Room::Sphere;
    sphere.radius = bad;
    EXPECT_THAT(reason(sphere), HasSubstr("finite")) << bad;
    Scene plane;
    plane.room = Scene::Room::Plane;
    plane.point = {0, bad, 0};
    plane.normal = {0, 0, 1};
    EXPECT_THAT(reason(plane), HasSubstr("finite")) << bad;
  }
  Scene sphere;
  sphere.room = Scene::Room::Sphere;
  sphere.radius = -3;
  EXPECT_THAT(reason(sphere), HasSubstr("radius must be above 0"));
  Scene plane;
  plane.room = Scene::Room::Plane;
  for (const Vec3& normal : {Vec3{}, Vec3{nan, 0, 0}, Vec3{0, kInfinity, 0}}) {
    plane.normal = normal;
    EXPECT_THAT(reason(plane), HasSubstr("normal"));
  }
}

}  // namespace
}  // namespace orbwatch::optics
