// SPDX-License-Identifier: Apache-2.0
#include "proc/align/register/registration.h"

#include <gtest/gtest.h>

#include "proc/align/rotation_fit.h"
#include "proc/optics/rotation.h"

namespace orbwatch::align {
namespace {

using optics::Mat3;
using optics::radians;
using optics::Vec3;

/// A camera 10 radii away on +Y of a ball of 50 mm, somewhere in a machine, not facing the ball's
/// centre.
optics::RigCamera placed_camera(const optics::Ball& ball) {
  optics::RigCamera camera;
  camera.name = "B";
  camera.width = 800;
  camera.height = 600;
  camera.intrinsics = optics::Intrinsics{800, 600, 1500, 1500, 399.5, 299.5};
  const Mat3 straight{{-1, 0, 0}, {0, 0, -1}, {0, -1, 0}};
  camera.pose = optics::Pose{rotation_about({0.05, 0.02, 0.04}) * straight,
                             ball.centre + Vec3{0, 10 * ball.radius, 0}};
  return camera;
}

Registration good() {
  Registration r;
  r.inliers = 100;
  r.overlap = 0.9;
  r.covariance = {{1e-8, 0, 0}, {0, 4e-8, 0}, {0, 0, 1e-8}};
  return r;
}

TEST(Registration, APoseIsTheSamePlaceAsOutlineAndRotation) {
  optics::Rig rig;
  rig.ball = {{120, 60, 430}, 50};
  const optics::RigCamera camera = placed_camera(rig.ball);
  const auto turnable = by_outline(rig, camera);
  ASSERT_TRUE(turnable) << turnable.error().message;
  EXPECT_FALSE(turnable->pose);
  Registration found;
  found.rotation = turnable->registration;
  found.outline = *turnable->outline;
  const auto pose = pose_of({{}, rig, *turnable, 0}, found);
  ASSERT_TRUE(pose) << pose.error().message;
  EXPECT_LT(norm(pose->position - camera.pose->position), 1e-6);
  EXPECT_LT(angle_between(pose->rotation, camera.pose->rotation), 1e-9);
}

TEST(Registration, ATurnMovesTheCameraAroundTheBall) {
  optics::Rig rig;
  rig.ball = {{120, 60, 430}, 50};
  const optics::RigCamera camera = *by_outline(rig, placed_camera(rig.ball));
  const Mat3 turn = rotation_about({0, 0, radians(90)});
  Registration found;
  found.rotation = turn * camera.registration;
  found.outline = *camera.outline;
  const auto pose = pose_of({{}, rig, camera, 0}, found);
  ASSERT_TRUE(pose) << pose.error().message;
  // The camera moves from +Y to -X.
  EXPECT_LT(norm(pose->position - (rig.ball.centre + Vec3{-500, 0, 0})), 1e-6);
}

TEST(Registration, IsRefusedWhenItIsNotSure) {
  EXPECT_TRUE(trusted(good(), 15));
  Registration few = good(), apart = good(), wide = good(), broken = good();
  few.inliers = 14;
  apart.overlap = 0.05;
  wide.covariance.row1.y = 1e-3;
  broken.covariance.row2.z = std::nan("");
  for (const Registration& bad : {few, apart, wide, broken}) {
    const auto refused = trusted(bad, 15);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find(": "), std::string::npos) << "says what to do";
  }
}

TEST(Registration, CamerasOppositeEachOtherShareAllButTheirBlindCones) {
  const auto model = optics::BallModel::make(optics::BallModel::Kind::Exact, {}, 10.0);
  ASSERT_TRUE(model);
  const optics::Outline limb{{400, 300}, 200, 200, 0};
  const auto a = optics::BallProjection::make(*model, limb, {});
  const auto b = optics::BallProjection::make(*model, limb, optics::rotation({180, 0, 0}));
  ASSERT_TRUE(a && b);
  // Each camera is blind within asin(1/10) of straight away.
  const double blind = (1 - std::cos(std::asin(0.1))) / 2;
  EXPECT_NEAR(overlap(*a, 800, 600, *b, 800, 600), 1 - 2 * blind, 0.002);
  EXPECT_NEAR(overlap(*a, 800, 600, *a, 800, 600), 1 - blind, 0.002);
  EXPECT_NEAR(overlap(*a, 401, 600, *a, 800, 600), 0.5, 0.01) << "half is outside of the picture";
}

}  // namespace
}  // namespace orbwatch::align
