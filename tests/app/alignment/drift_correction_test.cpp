// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/drift_correction.h"

#include <gtest/gtest.h>

#include <cmath>

#include "app/model/alignment/rig_alignment.h"
#include "proc/align/register/registration.h"
#include "proc/align/rotation_fit.h"
#include "tests/app/alignment/rig_with_pose.h"

namespace orbwatch::app {
namespace {

const optics::Vec3 kSeen = optics::normalized(optics::Vec3{-0.4, -0.8, 0.3});

optics::Rig drifting_rig() { return tests::rig_with_pose({100, -540, 440}); }

/// A small turn about the camera's x axis, then its z axis.
optics::Mat3 turn() {
  const double a = 0.01, b = 0.02;
  const optics::Mat3 about_x{
      {1, 0, 0}, {0, std::cos(a), -std::sin(a)}, {0, std::sin(a), std::cos(a)}};
  const optics::Mat3 about_z{
      {std::cos(b), -std::sin(b), 0}, {std::sin(b), std::cos(b), 0}, {0, 0, 1}};
  return about_z * about_x;
}

/// The pixel that shows a direction.
optics::Vec2 pixel(const optics::Rig& rig) {
  const auto ball = optics::ball_projection(rig, rig.cameras.front());
  EXPECT_TRUE(ball) << ball.error().message;
  const auto pixel = ball->pixel(kSeen);
  EXPECT_TRUE(pixel);
  return pixel.value_or(optics::Vec2{});
}

/// The rig after its camera was turned, and that drift.
struct Turned {
  optics::Rig rig = drifting_rig();
  align::DriftState drift;

  Turned() {
    rig.cameras[0].pose->rotation = turn() * rig.cameras[0].pose->rotation;
    drift.level = align::DriftLevel::Alarm;
    drift.turn = turn();
    drift.outline = *optics::ball_projection(rig, rig.cameras[0])->outline();
  }
};

void expect_corrects(optics::Rig rig, const Turned& truth) {
  const auto alignment = corrected(rig, rig.cameras[0], truth.drift);
  ASSERT_TRUE(alignment) << alignment.error().message;
  ASSERT_TRUE(apply({std::nullopt, {*alignment}}, rig));
  EXPECT_NEAR(pixel(rig).u, pixel(truth.rig).u, 0.01);
  EXPECT_NEAR(pixel(rig).v, pixel(truth.rig).v, 0.01);
}

TEST(DriftCorrection, TurnsACameraThatHasAPose) {
  const Turned truth;
  EXPECT_GT(std::abs(pixel(drifting_rig()).v - pixel(truth.rig).v), 10);
  expect_corrects(drifting_rig(), truth);
}

TEST(DriftCorrection, TurnsACameraThatHasAnOutline) {
  optics::Rig rig = drifting_rig();
  rig.cameras[0] = *align::by_outline(rig, rig.cameras[0]);
  expect_corrects(rig, Turned());
}

TEST(DriftCorrection, MovesTheOutlineWhenTheBallMoved) {
  optics::Rig rig = drifting_rig();
  align::DriftState drift;
  drift.level = align::DriftLevel::Warning;
  drift.outline = *optics::ball_projection(rig, rig.cameras[0])->outline();
  drift.outline.centre.u += 3;
  const auto alignment = corrected(rig, rig.cameras[0], drift);
  ASSERT_TRUE(alignment);
  EXPECT_EQ(alignment->outline->centre.u, drift.outline.centre.u);
  EXPECT_TRUE(alignment->registration);
}

/// A camera with an outline alone.
optics::Rig rig_without_lens(const optics::Outline& outline) {
  optics::Rig rig = drifting_rig();
  optics::RigCamera& camera = rig.cameras[0];
  camera.registration = align::by_outline(rig, camera)->registration;
  camera.outline = outline;
  camera.distance = 12;
  camera.pose.reset();
  camera.intrinsics.reset();
  return rig;
}

TEST(DriftCorrection, RollsACameraWithoutALens) {
  for (const optics::Outline& outline :
       {optics::Outline{{410, 390}, 300, 300, 0}, optics::Outline{{410, 390}, 310, 300, 25}}) {
    optics::Rig rig = rig_without_lens(outline);
    align::DriftState drift;
    drift.level = align::DriftLevel::Alarm;
    drift.motion = {3, -2, 0.01, 0.05};
    drift.outline = align::moved(outline, drift.motion);
    const optics::Vec2 moved = align::after(drift.motion, outline, pixel(rig));
    const auto alignment = corrected(rig, rig.cameras[0], drift);
    ASSERT_TRUE(alignment) << alignment.error().message;
    ASSERT_TRUE(apply({std::nullopt, {*alignment}}, rig));
    EXPECT_NEAR(pixel(rig).u, moved.u, 1e-6);
    EXPECT_NEAR(pixel(rig).v, moved.v, 1e-6);
  }
}

/// The ball is beside the picture's middle, so that its line is not the lens's axis.
TEST(DriftCorrection, RollsACameraWithALensAboutTheLineToTheBall) {
  constexpr double kRoll = 0.03;
  const optics::Rig rig = drifting_rig();
  Turned truth;
  const optics::Pose& pose = *rig.cameras[0].pose;
  const optics::Vec3 sight = optics::normalized(pose.rotation * (rig.ball.centre - pose.position));
  truth.rig = rig;
  truth.rig.cameras[0].pose->rotation = align::rotation_about(sight * kRoll) * pose.rotation;
  truth.drift.turn.reset();
  truth.drift.outline = *optics::ball_projection(truth.rig, truth.rig.cameras[0])->outline();
  truth.drift.motion = {0, 0, std::cos(kRoll) - 1, std::sin(kRoll)};
  EXPECT_GT(std::hypot(pixel(rig).u - pixel(truth.rig).u, pixel(rig).v - pixel(truth.rig).v), 1);
  expect_corrects(rig, truth);
}

TEST(DriftCorrection, RefusesWhatWasNotMeasured) {
  const optics::Rig rig = drifting_rig();
  align::DriftState drift;
  drift.reason = "too dark";
  const auto alignment = corrected(rig, rig.cameras[0], drift);
  ASSERT_FALSE(alignment);
  EXPECT_NE(alignment.error().message.find("too dark"), std::string::npos);
}

TEST(DriftCorrection, RefusesADriftWhoseZeroIsBeingLearnt) {
  const optics::Rig rig = drifting_rig();
  align::DriftState drift;
  drift.level = align::DriftLevel::Good;
  drift.is_learning = true;
  const auto alignment = corrected(rig, rig.cameras[0], drift);
  ASSERT_FALSE(alignment);
  EXPECT_NE(alignment.error().message.find("learnt"), std::string::npos);
}

}  // namespace
}  // namespace orbwatch::app
