// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <optional>
#include <random>
#include <string>
#include <vector>

#include "proc/align/register/consensus/refinement.h"
#include "proc/align/register/consensus/rotation_consensus.h"
#include "proc/align/register/features/feature_registration.h"
#include "proc/align/register/spiral.h"
#include "proc/align/rotation_fit.h"
#include "tests/proc/align/register/camera_pair.h"

/// Registration of a camera behind a window, whose normal is fixed in the machine: some of the
/// rotations that are tried turn the camera until the glass stands edge-on.
namespace orbwatch::align {
namespace {

using optics::degrees;
using optics::Mat3;
using optics::radians;
using optics::Vec2;
using optics::Vec3;

constexpr optics::Ball kBall{{100, 200, 300}, 50};
constexpr double kGlass = 10;  // mm

/// A camera ten radii away on +Y that looks along -Y, turned about the ball.
optics::RigCamera camera_turned_by(const std::string& name, const Mat3& turn) {
  const Mat3 straight{{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}};
  optics::RigCamera camera;
  camera.name = name;
  camera.width = 800;
  camera.height = 600;
  camera.intrinsics = optics::Intrinsics{800, 600, 1500, 1500, 399.5, 299.5, {}, {}};
  camera.pose = optics::Pose{straight * transposed(turn),
                             kBall.centre + turn * Vec3{0, 10 * kBall.radius, 0}};
  return camera;
}

/// Matches of two cameras in one machine, half of them wrong. The second camera looks straight
/// through its glass, and its rotation is sought.
struct MatchesBehindGlass {
  MatchesBehindGlass(const Mat3& turn, bool is_scene_stated) : truth(turn) {
    rig.ball = kBall;
    optics::RigCamera camera = camera_turned_by("B", truth);
    camera.window = optics::Window{camera.pose->rotation.row2, kGlass};
    const auto behind_glass = optics::ball_projection(rig, camera).value();
    for (int n = 0; n < 400; ++n) {
      const double closeness = is_scene_stated ? 0.125 : even(0.03, 0.2);
      const auto a = reference().pixel(spiral(n, 400), closeness);
      const auto b = behind_glass.pixel(spiral(n, 400), closeness);
      if (a && b) matches.push_back({noisy(*a), n % 2 == 0 ? noisy(*b) : anywhere()});
    }
    sought.camera = by_outline(rig, camera).value();
    sought.camera.registration = {};
    if (is_scene_stated) {
      rig.scene.room = optics::Scene::Room::Sphere;
      rig.scene.centre = kBall.centre;
      rig.scene.radius = kBall.radius / 0.125;
    }
    sought.rig = rig;
  }

  optics::BallProjection reference() const {
    return optics::ball_projection(rig, camera_turned_by("A", {})).value();
  }
  double even(double least, double most) {
    return std::uniform_real_distribution<double>(least, most)(random);
  }
  Vec2 noisy(const Vec2& pixel) {
    std::normal_distribution<double> noise(0, 0.1);
    const double u = noise(random), v = noise(random);
    return {pixel.u + u, pixel.v + v};
  }
  Vec2 anywhere() {
    const double u = even(300, 500), v = even(200, 400);
    return {u, v};
  }

  std::mt19937 random{1};
  optics::Rig rig;
  Mat3 truth;
  SoughtCamera sought{};
  std::vector<Match> matches;
};

/// Registration with and without a stated scene.
class WindowedRegistration : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(SceneOrNone, WindowedRegistration, testing::Bool());

TEST_P(WindowedRegistration, PassesOverTurnsThatPutTheGlassEdgeOn) {
  // The second one: before any turn, the glass is edge-on.
  for (const Mat3& turn : {rotation_about({0.3, -0.2, 1.2}), rotation_about({0, 0, radians(89)})}) {
    const MatchesBehindGlass seen(turn, GetParam());
    const auto found = agree_on_rotation(seen.matches, seen.reference(), seen.sought);
    ASSERT_TRUE(found) << found.error().message;
    EXPECT_LT(degrees(angle_between(found->rotation, seen.truth)), 2);
    EXPECT_LT(found->rival, found->agreeing / 2);
    const auto fine = refine_rotation(found->inliers, seen.reference(), seen.sought,
                                      {found->rotation, *seen.sought.camera.outline, found->room});
    ASSERT_TRUE(fine) << fine.error().message;
    EXPECT_LT(degrees(angle_between(fine->state.rotation, seen.truth)), 0.3);
  }
}

TEST_P(WindowedRegistration, IsFoundByFeaturesOfPictures) {
  auto pair = tests::camera_pair(501, false);
  pair.sought.window =
      optics::Window{pair.room.second.axes.row2, kGlass / kBall.radius * pair.rig.ball.radius};
  if (!GetParam()) pair.rig.scene = {};
  const auto found = register_by_features(pair.reference(), pair.unknown());
  ASSERT_TRUE(found) << found.error().message;
  EXPECT_LT(degrees(angle_between(found->rotation, pair.truth)), 0.5);
}

TEST(InOwnFrame, HasNoWindow) {
  SoughtCamera sought{};
  sought.rig.ball = kBall;
  const Mat3 turn = rotation_about({0, 0, radians(89)});
  optics::RigCamera camera = camera_turned_by("B", turn);
  camera.window = optics::Window{camera.pose->rotation.row2, kGlass};
  sought.camera = by_outline(sought.rig, camera).value();
  EXPECT_TRUE(turned(sought, turn, *sought.camera.outline));
  const auto own = in_own_frame(sought);
  ASSERT_TRUE(own) << own.error().message;
  EXPECT_LT(norm(own->facing() - Vec3{0, 1, 0}), 1e-3);
}

}  // namespace
}  // namespace orbwatch::align
