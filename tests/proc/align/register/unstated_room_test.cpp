// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "proc/align/register/consensus/refinement.h"
#include "proc/align/register/consensus/rotation_consensus.h"
#include "proc/align/register/light/line_of_sight.h"
#include "proc/align/register/spiral.h"
#include "proc/align/rotation_fit.h"

/// Registration of two cameras in an unstated room.
namespace orbwatch::align {
namespace {

using optics::degrees;
using optics::Mat3;
using optics::radians;
using optics::Vec2;
using optics::Vec3;

optics::RigCamera camera_beside_ball(const std::string& name, double distance) {
  optics::RigCamera camera;
  camera.name = name;
  camera.width = 800;
  camera.height = 600;
  camera.outline = optics::Outline{{400, 300}, 250, 250, 0};
  camera.distance = distance;
  return camera;
}

/// The sights of both cameras in a room in which everything has the closeness `closeness(random)`.
struct UnstatedRoom {
  template <class Closeness>
  explicit UnstatedRoom(const Closeness& closeness) {
    rig.ball = {{100, 200, 300}, 50};
    const auto seen = turned(sought, truth, *sought.camera.outline).value();
    for (int n = 0; n < 400; ++n) {
      const Vec3 direction = spiral(n, 400);
      const double close = closeness(random);
      const auto a = reference().pixel(direction, close), b = seen.pixel(direction, close);
      if (a && b) matches.push_back({noisy(*a), noisy(*b)});
    }
  }

  optics::BallProjection reference() const {
    return optics::ball_projection(rig, camera_beside_ball("A", 9)).value();
  }
  Vec2 noisy(const Vec2& pixel) {
    std::normal_distribution<double> noise(0, 0.2);
    return {pixel.u + noise(random), pixel.v + noise(random)};
  }

  std::mt19937 random{1};
  optics::Rig rig;
  Mat3 truth = rotation_about({0.3, -0.2, 1.2});
  SoughtCamera sought{{}, rig, camera_beside_ball("B", 14), 0};
  std::vector<Match> matches;
};

double even(double least, double most, std::mt19937& random) {
  return std::uniform_real_distribution<double>(least, most)(random);
}

TEST(LineOfSight, MeetsASphereWhereTheSceneDoes) {
  optics::Rig rig;
  rig.ball = {{100, 200, 300}, 50};
  rig.scene.room = optics::Scene::Room::Sphere;
  rig.scene.centre = rig.ball.centre;
  rig.scene.radius = 200;
  const auto ball = optics::ball_projection(rig, camera_beside_ball("A", 9));
  ASSERT_TRUE(ball) << ball.error().message;
  for (const Vec2 pixel : {Vec2{400, 300}, Vec2{450, 250}, Vec2{200, 310}, Vec2{400, 545}}) {
    const auto line = line_of_sight(*ball, pixel);
    ASSERT_TRUE(line);
    EXPECT_LT(norm(direction_at(*line, 0.25) - *ball->direction(pixel)), 1e-9);
  }
  EXPECT_FALSE(line_of_sight(*ball, {400, 560}));
}

TEST(LineOfSight, TwoTellWhereTheyMeetUnlessTheRoomIsSurer) {
  const Vec3 point{2, 3, 4};
  const auto towards = [&](const Vec3& origin) {
    return LineOfSight{origin, optics::normalized(point - origin)};
  };
  const LineOfSight a = towards({1, 0, 0}), b = towards({0, -0.6, 0.8});
  const Meeting free = meeting(a, b, 0.001, {0, 1});
  EXPECT_NEAR(free.closeness, 1 / norm(point), 1e-5);
  EXPECT_LT(norm(free.apart), 1e-5);
  EXPECT_NEAR(meeting(a, b, 0.001, {0.05, 1e-6}).closeness, 0.05, 1e-5);
}

TEST(UnstatedRoom, ItsClosenessIsFoundAlongWithTheRotation) {
  struct Case {
    const char* name;
    double least, most;  // closeness
  };
  for (const Case& room : {Case{"far away", 0, 0}, Case{"a hall", 0.005, 0.01},
                           Case{"a machine", 0.05, 0.12}, Case{"a cabinet", 0.1, 0.3}}) {
    SCOPED_TRACE(room.name);
    const UnstatedRoom seen([&](auto& random) { return even(room.least, room.most, random); });
    const Mat3 start = rotation_about({0.02, 0.02, -0.02}) * seen.truth;
    const auto found = refine_rotation(seen.matches, seen.reference(), seen.sought,
                                       {start, *seen.sought.camera.outline, RoomCloseness{0, 0.1}});
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_LT(degrees(angle_between(found->state.rotation, seen.truth)), 0.05);
    EXPECT_NEAR(found->state.room->mean, (room.least + room.most) / 2, 0.01);
    EXPECT_NEAR(found->state.room->spread, (room.most - room.least) / std::sqrt(12), 0.01);
    EXPECT_LT(angle_between(found->state.rotation, seen.truth),
              4 * std::sqrt(found->covariance.row0.x + found->covariance.row1.y +
                            found->covariance.row2.z));
  }
}

/// Cameras at one place have the same sights at any distance.
TEST(UnstatedRoom, NeedNotTellHowCloseItIs) {
  UnstatedRoom seen([](auto& random) { return even(0.05, 0.12, random); });
  seen.sought.camera.distance = 9;
  for (Match& match : seen.matches) match.camera = seen.noisy(match.reference);
  const auto found = refine_rotation(seen.matches, seen.reference(), seen.sought,
                                     {Mat3{}, *seen.sought.camera.outline, RoomCloseness{0, 0.1}});
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT(degrees(angle_between(found->state.rotation, Mat3{})), 0.05);
}

TEST(UnstatedRoom, ARotationIsFoundAmongFalseMatchesWithoutAStart) {
  UnstatedRoom seen([](auto& random) { return even(0.03, 0.2, random); });
  for (std::size_t n = 0; n < seen.matches.size(); n += 2) {
    seen.matches[n].camera = {even(250, 550, seen.random), even(150, 450, seen.random)};
  }
  const auto found = agree_on_rotation(seen.matches, seen.reference(), seen.sought);
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT(degrees(angle_between(found->rotation, seen.truth)), 2);
  EXPECT_LT(found->rival, found->agreeing / 2);
  ASSERT_TRUE(found->room);
  EXPECT_NEAR(found->room->mean, 0.115, 0.03);
}

TEST(UnstatedRoom, IsNoneWhereAnythingIsStated) {
  optics::Rig rig;
  EXPECT_FALSE(states_scene(rig));
  rig.scene.obstacles.push_back({{1, 1, 1}, {2, 2, 2}});
  EXPECT_TRUE(states_scene(rig));
  rig.scene = {};
  rig.scene.room = optics::Scene::Room::Plane;
  EXPECT_TRUE(states_scene(rig));
}

}  // namespace
}  // namespace orbwatch::align
