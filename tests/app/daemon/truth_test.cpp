// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <numbers>
#include <random>

#include "app/simulation/scene/static_scene.h"
#include "proc/optics/rig.h"
#include "proc/optics/vec.h"
#include "tests/app/daemon/demo_site.h"
#include "tests/app/daemon/simulated_scene.h"
#include "tests/app/simulation/camera_truth.h"

/// Compares the product's projections with the simulated machine's truth: its pictures come from
/// plain vector reflection, without a ball model.
namespace orbwatch::app::daemon {
namespace {

using optics::Vec3;
using simulation::CameraTruth;
using simulation::Pinhole;

optics::BallProjection projection_of(const CameraTruth& truth) {
  const optics::Outline outline{
      {truth.outline.cx, truth.outline.cy}, truth.outline.radius, truth.outline.radius, 0};
  return optics::BallProjection::make(
             optics::BallModel::make(optics::BallModel::Kind::Exact, truth.alpha).value(), outline,
             truth.rotation)
      .value();
}

void expect_equal(const Vec3& a, const Vec3& b) {
  EXPECT_EQ(a.x, b.x);
  EXPECT_EQ(a.y, b.y);
  EXPECT_EQ(a.z, b.z);
}

void expect_equal(const optics::Box& a, const optics::Box& b) {
  expect_equal(a.low, b.low);
  expect_equal(a.high, b.high);
}

TEST(Truth, TheShippedDemoFileDescribesItsSimulatedCameras) {
  const files::Resolved site = demo();
  const simulation::MachineSettings machine;
  ASSERT_EQ(site.site.cameras.size(), site.rig.cameras.size());
  for (std::size_t i = 0; i < site.site.cameras.size(); ++i) {
    const files::CameraSettings& camera = site.site.cameras[i];
    SCOPED_TRACE(camera.name);
    ASSERT_EQ(site.rig.cameras[i].name, camera.name);
    const auto& simulated = std::get<simulation::SimulatedCameraSettings>(camera.back_end);
    const Pinhole pinhole =
        simulation::look_at(simulated.position, machine.ball.centre, simulated.horizontal_fov,
                            camera.stream.width, camera.stream.height);
    const CameraTruth truth = simulation::truth_of(pinhole, machine.ball);
    const auto ball = optics::ball_projection(site.rig, site.rig.cameras[i]).value();
    const auto outline = ball.outline().value();
    EXPECT_NEAR(outline.centre.u, truth.outline.cx, 1e-3);
    EXPECT_NEAR(outline.centre.v, truth.outline.cy, 1e-3);
    EXPECT_NEAR(outline.rx, truth.outline.radius, 1e-3);
    EXPECT_NEAR(outline.ry, truth.outline.radius, 1e-3);
    // Distant objects are in the directions of the truth, so nothing is turned or mirrored.
    const auto far_truth = projection_of(truth);
    std::mt19937 random(3);
    std::normal_distribution<double> normal;
    for (int n = 0; n < 1000; ++n) {
      const Vec3 direction = optics::normalized({normal(random), normal(random), normal(random)});
      constexpr double kBlind = -0.98;  // cosine; around the blind cones of both cameras
      if (optics::dot(direction, far_truth.facing()) < kBlind) continue;
      const auto pixel = ball.pixel(direction, 0), expected = far_truth.pixel(direction);
      ASSERT_TRUE(pixel && expected);
      ASSERT_NEAR(pixel->u, expected->u, 1e-3);
      ASSERT_NEAR(pixel->v, expected->v, 1e-3);
    }
  }
}

TEST(Truth, TheShippedRigDescribesTheSimulatedMachine) {
  const optics::Rig rig = demo().rig;
  const simulation::MachineSettings machine;
  expect_equal(rig.ball.centre, machine.ball.centre);
  EXPECT_EQ(rig.ball.radius, machine.ball.radius);
  const optics::Scene scene = scene_of(machine);
  EXPECT_EQ(rig.scene.room, scene.room);
  expect_equal(rig.scene.walls, scene.walls);
  ASSERT_EQ(rig.scene.obstacles.size(), scene.obstacles.size());
  for (std::size_t i = 0; i < scene.obstacles.size(); ++i) {
    expect_equal(rig.scene.obstacles[i], scene.obstacles[i]);
  }
}

TEST(Truth, TheExactModelIsPlainReflection) {
  std::mt19937 random(8);
  std::uniform_real_distribution<double> unit(0, 1);
  const simulation::Sphere ball{{10, -20, 300}, 40};
  for (int i = 0; i < 5000; ++i) {
    const double distance = ball.radius * (1.05 + 30 * unit(random));
    const Vec3 away =
        optics::normalized({unit(random) - 0.5, unit(random) - 0.5, 0.6 * (unit(random) - 0.5)});
    const Pinhole camera =
        simulation::look_at(ball.centre + away * distance, ball.centre, 60, 900, 700);
    const CameraTruth truth = simulation::truth_of(camera, ball);
    const double angle = 2 * std::numbers::pi * unit(random), rho = 0.999 * std::sqrt(unit(random));
    const optics::Vec2 pixel{truth.outline.cx + rho * truth.outline.radius * std::cos(angle),
                             truth.outline.cy + rho * truth.outline.radius * std::sin(angle)};
    const auto sight = simulation::sight_along(camera.ray_through(pixel.u, pixel.v), ball);
    ASSERT_TRUE(sight.on_ball());
    const auto direction = projection_of(truth).direction(pixel);
    ASSERT_TRUE(direction);
    // Rounding of the hit point has the largest effect near the limb.
    EXPECT_LT(optics::degrees(optics::angle_between(*direction, sight.mirrored.direction)), 1e-5);
  }
}

}  // namespace
}  // namespace orbwatch::app::daemon
