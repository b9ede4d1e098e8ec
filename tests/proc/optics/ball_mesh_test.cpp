// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/ball_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "proc/optics/resolution.h"
#include "tests/proc/optics/random_camera.h"

namespace orbwatch::optics {
namespace {

using tests::random_camera;
using tests::random_direction;
using tests::scene_around_ball;

constexpr double kDegree = 3.14159265358979 / 180;

struct Drawn {
  double distance;
  std::optional<Vec2> pixel;  ///< nullopt: blind
};

/// Intersection of a ray from the ball's centre with a triangle (Moeller and Trumbore), and the
/// pixel there.
std::optional<Drawn> meet(const BallMesh& mesh, const Vec3& ray, const std::uint32_t* corners) {
  const BallMesh::Node &a = mesh.nodes[corners[0]], &b = mesh.nodes[corners[1]],
                       &c = mesh.nodes[corners[2]];
  const Vec3 ab = b.position - a.position, ac = c.position - a.position;
  const Vec3 p = cross(ray, ac), q = cross(-a.position, ab);
  const double determinant = dot(ab, p);
  const double u = dot(-a.position, p) / determinant, v = dot(ray, q) / determinant;
  const double distance = dot(ac, q) / determinant;
  if (!(u >= 0 && v >= 0 && u + v <= 1 && distance > 0)) return std::nullopt;
  const double w = 1 - u - v;
  const Vec2 distant = mesh.distant(ray);
  return Drawn{distance, Vec2{distant.u + w * a.offset.u + u * b.offset.u + v * c.offset.u,
                              distant.v + w * a.offset.v + u * b.offset.v + v * c.offset.v}};
}

/// The result of a graphics processor in a direction: the nearest triangle.
std::optional<Drawn> draw(const BallMesh& mesh, const Vec3& ray) {
  std::optional<Drawn> nearest;
  for (const auto* triangles : {&mesh.triangles, &mesh.blind}) {
    for (std::size_t k = 0; k < triangles->size(); k += 3) {
      auto drawn = meet(mesh, ray, triangles->data() + k);
      if (!drawn || (nearest && drawn->distance >= nearest->distance)) continue;
      if (triangles == &mesh.blind) drawn->pixel.reset();
      nearest = drawn;
    }
  }
  return nearest;
}

ViewProjection ball_view(const BallProjection& ball) {
  return ViewProjection::make({ViewKind::Ball, {}, {}, {}, 1000, 900}, ball).value();
}

/// True if the blind cone begins within a degree.
bool is_near_blind_cone(const BallProjection& ball, const Vec3& direction) {
  const Vec3 axis = -ball.facing();
  const Vec3 towards_it = normalized(axis - direction * dot(axis, direction));
  return !ball.pixel(normalized(direction + towards_it * kDegree));
}

class BallMeshOf : public testing::TestWithParam<std::tuple<Scene::Room, bool>> {};

TEST_P(BallMeshOf, ShowsWhatTheExactModelShows) {
  const auto [room, obstacles] = GetParam();
  std::mt19937 random(7);
  for (const double distance : {6.0, 12.0}) {
    const auto ball =
        BallProjection::make(BallModel::Kind::Exact, random_camera(random, distance, 2),
                             tests::kBall, scene_around_ball(room, obstacles))
            .value();
    const ViewProjection view = ball_view(ball);
    const BallMesh mesh = ball_mesh(view);
    EXPECT_LT(mesh.nodes.size(), 45000U);
    int compared = 0, blind = 0;
    for (int n = 0; n < 400; ++n) {
      Vec3 direction = random_direction(random);
      // Some directions are in and about the blind cone, which is narrow.
      if (n % 10 == 0) direction = normalized(direction * 0.1 - ball.facing());
      const auto exact = view.pixel(direction);
      const auto drawn = draw(mesh, direction);
      ASSERT_TRUE(drawn) << "there is a hole";
      if (!exact) {
        EXPECT_FALSE(drawn->pixel) << "the blind cone is drawn";
        ++blind;
      } else if (drawn->pixel) {
        // A triangle may be curved twice between the places where it was checked.
        EXPECT_LT(std::hypot(drawn->pixel->u - exact->u, drawn->pixel->v - exact->v), 1.5 / 32);
        ++compared;
      } else {
        EXPECT_TRUE(is_near_blind_cone(ball, direction)) << resolution(ball, direction);
      }
    }
    EXPECT_GT(compared, 350);
    EXPECT_GT(blind, 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Rooms, BallMeshOf,
                         testing::Combine(testing::Values(Scene::Room::None, Scene::Room::Sphere,
                                                          Scene::Room::Plane, Scene::Room::Box),
                                          testing::Bool()));

TEST(BallMesh, BehindATiltedWindowIsFiniteOrEmpty) {
  std::mt19937 random(5);
  CalibratedCamera camera = random_camera(random, 9, 0);
  const Vec3 towards = normalized(camera.pose.position - tests::kBall.centre);
  const Vec3 along_the_glass = normalized(cross(towards, {0.3, 0.2, 1}));
  int drawn = 0, empty = 0;
  for (double tilt = 0; tilt < 0.3; tilt += 0.005) {
    camera.window = Window{along_the_glass + towards * tilt, 20};
    const auto ball = BallProjection::make(BallModel::Kind::Exact, camera, tests::kBall,
                                           scene_around_ball(Scene::Room::Box, false));
    ASSERT_TRUE(ball) << ball.error().message;
    const auto view = ViewProjection::make({ViewKind::Ball, {}, {}, {}, 200, 180}, *ball);
    if (!view) continue;  // nothing of its limb is shown
    const BallMesh mesh = ball_mesh(*view);
    EXPECT_TRUE(std::isfinite(mesh.centre.u + norm(mesh.u) + norm(mesh.v))) << tilt;
    ++(mesh.nodes.empty() ? empty : drawn);
  }
  EXPECT_GT(empty, 0);
  EXPECT_GT(drawn, 0);
}

TEST(BallMesh, NodesHaveTheResolutionThere) {
  std::mt19937 random(3);
  const auto ball = BallProjection::make(BallModel::Kind::Exact, random_camera(random, 9, 0),
                                         tests::kBall, scene_around_ball(Scene::Room::Box, true))
                        .value();
  const BallMesh mesh = ball_mesh(ball_view(ball));
  ASSERT_GT(mesh.nodes.size(), 1000U);
  std::size_t seen = 0;
  for (std::size_t k = 0; k < mesh.nodes.size(); k += 97) {
    const BallMesh::Node& node = mesh.nodes[k];
    const double truth = resolution(ball, normalized(node.position));
    EXPECT_TRUE(node.resolution == truth || node.resolution == 0);
    seen += node.resolution > 0 ? 1 : 0;
  }
  EXPECT_GT(seen, mesh.nodes.size() / 97 / 2);
}

}  // namespace
}  // namespace orbwatch::optics
