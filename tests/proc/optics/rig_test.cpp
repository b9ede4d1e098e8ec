// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/rig.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "proc/optics/vec.h"
#include "tests/proc/optics/random_camera.h"

namespace orbwatch::optics {
namespace {

using tests::random_direction;

const Intrinsics kIntrinsics{1500, 1500, 2700, 2700, 749.5, 749.5, Distortion::None, {}};

/// A camera at `position` that faces `target`, some degrees beside the ball.
Pose looking_past(const Vec3& position, const Vec3& target) {
  const Vec3 forward = normalized(target - position);
  const Vec3 right = normalized(cross(forward, {0, 0, 1}));
  return {{right, cross(forward, right), forward}, position};
}

Rig rig_of(const RigCamera& camera) {
  Rig rig;
  rig.ball = {{120, 60, 430}, 50};
  rig.cameras = {camera};
  return rig;
}

RigCamera posed() {
  RigCamera camera;
  camera.name = "A";
  camera.width = camera.height = 1500;
  camera.intrinsics = kIntrinsics;
  camera.pose = looking_past({480, 200, 530}, {100, 90, 400});
  return camera;
}

RigCamera uncalibrated() {
  RigCamera camera;
  camera.name = "A";
  camera.width = camera.height = 1500;
  camera.outline = Outline{{700, 720}, 420, 410, 20};
  camera.distance = 9;
  return camera;
}

/// The camera's own axes, X = -right, Y = -forward, Z = -down, in the machine frame.
Mat3 registration_of(const Pose& pose) {
  return transposed({-pose.rotation.row0, -pose.rotation.row2, -pose.rotation.row1});
}

void expect_same(const BallProjection& a, const BallProjection& b, double tolerance) {
  std::mt19937 random(1);
  int seen = 0;
  for (int i = 0; i < 500; ++i) {
    const Vec3 direction = random_direction(random);
    // Directions at the limb may be visible to only one of them.
    if (dot(direction, a.facing()) < -0.95) continue;
    const auto pixel_a = a.pixel(direction), pixel_b = b.pixel(direction);
    ASSERT_EQ(pixel_a.has_value(), pixel_b.has_value());
    if (!pixel_a) continue;
    ++seen;
    EXPECT_NEAR(pixel_a->u, pixel_b->u, tolerance);
    EXPECT_NEAR(pixel_a->v, pixel_b->v, tolerance);
  }
  EXPECT_GT(seen, 300);
}

TEST(Rig, OutlineAndRegistrationStandForAPose) {
  const RigCamera by_pose = posed();
  const Rig rig = rig_of(by_pose);
  const BallProjection truth = ball_projection(rig, by_pose).value();
  RigCamera by_outline = by_pose;
  by_outline.pose.reset();
  by_outline.outline = truth.outline();
  by_outline.registration = registration_of(*by_pose.pose);
  expect_same(truth, ball_projection(rig, by_outline).value(), 1e-6);
}

TEST(Rig, SoTheyDoThroughAWindow) {
  RigCamera by_pose = posed();
  by_pose.window = Window{{1, 0.4, 0.2}, 12, 1.52};
  const Rig rig = rig_of(by_pose);
  const BallProjection truth = ball_projection(rig, by_pose).value();
  RigCamera by_outline = by_pose;
  by_outline.pose.reset();
  by_outline.outline = truth.outline();
  by_outline.registration = registration_of(*by_pose.pose);
  expect_same(truth, ball_projection(rig, by_outline).value(), 0.01);
}

TEST(Rig, CalibratedCameraThatLooksAtTheBallIsTheUncalibratedOne) {
  // Both ways to state the camera agree where both apply: the ball on the optical axis.
  RigCamera plain = uncalibrated();
  const double limb = std::tan(std::asin(1.0 / 9)) * kIntrinsics.fx;
  plain.outline = Outline{{749.5, 749.5}, limb, limb, 0};
  plain.registration = rotation({30, -10, 5});
  RigCamera calibrated = plain;
  calibrated.distance.reset();
  calibrated.intrinsics = kIntrinsics;
  const Rig rig = rig_of(plain);
  expect_same(ball_projection(rig, plain).value(), ball_projection(rig, calibrated).value(), 1e-6);
}

TEST(Rig, SceneCountsForEveryCamera) {
  for (const RigCamera& camera : {posed(), uncalibrated()}) {
    Rig rig = rig_of(camera);
    const auto far = ball_projection(rig, camera);
    rig.scene.room = Scene::Room::Box;
    rig.scene.walls = {{-600, -500, 0}, {600, 500, 800}};
    const auto near = ball_projection(rig, camera);
    ASSERT_TRUE(near) << near.error().message;
    EXPECT_FALSE(near->proxy().is_far());
    const Vec3 sideways = normalized(cross(near->facing(), {0, 0, 1}));
    EXPECT_GT(std::abs(far->pixel(sideways)->u - near->pixel(sideways)->u), 1);
  }
}

TEST(Rig, ModelIsTheCameras) {
  RigCamera camera = uncalibrated();
  const Rig rig = rig_of(camera);
  const Vec3 direction = normalized({1, 0.3, 0.2});
  const Vec2 exact = ball_projection(rig, camera)->pixel(direction).value();
  camera.model = BallModel::Kind::Paper;
  const Vec2 paper = ball_projection(rig, camera)->pixel(direction).value();
  EXPECT_GT(std::abs(exact.u - paper.u), 1);
  camera.model = BallModel::Kind::Classical;
  EXPECT_FALSE(ball_projection(rig, camera)) << "takes no distance";
  camera.distance.reset();
  EXPECT_TRUE(ball_projection(rig, camera));
}

struct Refusal {
  std::string name;
  void (*spoil)(Rig& rig, RigCamera& camera);
  std::string says;
  bool calibrated = true;
};

class RigRefusal : public testing::TestWithParam<Refusal> {};

TEST_P(RigRefusal, NamesTheCameraAndTheReason) {
  RigCamera camera = GetParam().calibrated ? posed() : uncalibrated();
  Rig rig = rig_of(camera);
  ASSERT_TRUE(ball_projection(rig, camera));
  GetParam().spoil(rig, camera);
  const auto projection = ball_projection(rig, camera);
  ASSERT_FALSE(projection);
  EXPECT_NE(projection.error().message.find(GetParam().says), std::string::npos)
      << projection.error().message;
  EXPECT_EQ(projection.error().message.find('\n'), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(
    Calibrated, RigRefusal,
    testing::Values(
        Refusal{"NoPlace", [](Rig&, RigCamera& c) { c.pose.reset(); }, "camera A: give either"},
        Refusal{"TwoPlaces", [](Rig&, RigCamera& c) { c.outline = uncalibrated().outline; },
                "camera A: give either"},
        Refusal{"PoseAlone", [](Rig&, RigCamera& c) { c.intrinsics.reset(); }, "needs intrinsics"},
        Refusal{"Alpha", [](Rig&, RigCamera& c) { c.alpha = 340; }, "alpha and distance follow"},
        Refusal{"Distance", [](Rig&, RigCamera& c) { c.distance = 9; },
                "alpha and distance follow"},
        Refusal{"OtherSize", [](Rig&, RigCamera& c) { c.width = 1499; }, "1500x1500"},
        Refusal{"NoLens", [](Rig&, RigCamera& c) { c.intrinsics->fx = 0; }, "camera A: "},
        Refusal{"NoGlass",
                [](Rig&, RigCamera& c) {
                  c.window = Window{{0, 0, 0}, 1, 1.5};
                },
                "camera A: the window"},
        Refusal{"MirroredPose",
                [](Rig&, RigCamera& c) { c.pose->rotation.row0 = -c.pose->rotation.row0; },
                "not a rotation"},
        Refusal{"WithinTheBall", [](Rig& r, RigCamera& c) { c.pose->position = r.ball.centre; },
                "camera A: "},
        Refusal{"LooksAway",
                [](Rig& r, RigCamera& c) {
                  c.pose->position = r.ball.centre + c.pose->rotation.row2 * 500;
                },
                "camera A: "},
        Refusal{"NoBall", [](Rig& r, RigCamera&) { r.ball.radius = 0; }, "ball: "},
        Refusal{"NegativeBall", [](Rig& r, RigCamera&) { r.ball.radius = -1; }, "ball: "},
        Refusal{"BallNowhere", [](Rig& r, RigCamera&) { r.ball.centre.x = std::nan(""); }, "ball"},
        Refusal{"SceneCutsTheBall",
                [](Rig& r, RigCamera&) {
                  r.scene.room = Scene::Room::Box;
                  r.scene.walls = {{-600, -500, 0}, {130, 500, 800}};
                },
                "scene: "}),
    [](const auto& refusal) { return refusal.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Uncalibrated, RigRefusal,
    testing::Values(
        Refusal{"NoAlpha", [](Rig&, RigCamera& c) { c.distance.reset(); }, "camera A: give", false},
        Refusal{"Both", [](Rig&, RigCamera& c) { c.alpha = 340; }, "camera A: give", false},
        Refusal{"TooNear", [](Rig&, RigCamera& c) { c.distance = 1; }, "above 1", false},
        Refusal{"WindowAlone", [](Rig&, RigCamera& c) { c.window = Window{}; }, "needs", false},
        Refusal{"NoRotation",
                [](Rig&, RigCamera& c) {
                  c.registration.row0 = {2, 0, 0};
                },
                "not a rotation", false},
        Refusal{"NoRotationButIntrinsics",
                [](Rig&, RigCamera& c) {
                  c.intrinsics = kIntrinsics;
                  c.distance.reset();
                  c.registration.row0 = {2, 0, 0};
                },
                "not a rotation", false},
        Refusal{"OutsideOfThePicture", [](Rig&, RigCamera& c) { c.outline->centre.u = 1600; },
                "outside of the picture", false},
        Refusal{"NoEllipse", [](Rig&, RigCamera& c) { c.outline->rx = 0; }, "radius", false},
        Refusal{"NoBallsOutline",
                [](Rig&, RigCamera& c) {
                  c.intrinsics = kIntrinsics;
                  c.distance.reset();
                  c.outline->rx = 200;
                },
                "not that of a ball", false}),
    [](const auto& refusal) { return refusal.param.name; });

}  // namespace
}  // namespace orbwatch::optics
