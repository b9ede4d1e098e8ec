// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <random>

#include "proc/optics/ball_projection.h"
#include "proc/optics/scene_proxy.h"
#include "proc/optics/vec.h"
#include "tests/proc/reference_optics.h"

/// One ball in one machine, and calibrated cameras anywhere around it.
namespace orbwatch::tests {

inline Vec3 random_direction(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return normalized(Vec3{normal(random), normal(random), normal(random)});
}

inline const optics::Ball kBall{{120, -40, 310}, 50};

inline optics::Lens plain_lens() {
  return optics::Lens::make({4000, 3000, 2500, 2400, 1990, 1510}).value();
}

/// A camera `distance` radii from the ball, anywhere around it and turned any way, its axis
/// off_axis degrees beside the ball's centre.
inline optics::CalibratedCamera random_camera(std::mt19937& random, double distance,
                                              double off_axis) {
  const Vec3 facing = random_direction(random);
  const Vec3 aside = normalized(cross(facing, random_direction(random)));
  const Vec3 forward = normalized(-facing + aside * std::tan(optics::radians(off_axis)));
  const Vec3 right = normalized(cross(forward, random_direction(random)));
  const optics::Pose pose{{right, cross(forward, right), forward},
                          kBall.centre + facing * (distance * kBall.radius)};
  return {plain_lens(), pose, {}};
}

/// The camera's position from the ball's centre, in ball radii.
inline RealVec3 position_in_radii(const optics::CalibratedCamera& camera) {
  return (RealVec3(camera.pose.position) - RealVec3(kBall.centre)) * (1 / Real(kBall.radius));
}

/// The ray of a pixel without distortion, machine frame, any length.
inline RealVec3 camera_ray(const optics::CalibratedCamera& camera, const Vec2& pixel) {
  const optics::Intrinsics& lens = camera.lens.intrinsics();
  const Real x = (Real(pixel.u) - lens.cx) / lens.fx;
  const Real y = (Real(pixel.v) - lens.cy) / lens.fy;
  const optics::Mat3& axes = camera.pose.rotation;
  return RealVec3(axes.row0) * x + RealVec3(axes.row1) * y + RealVec3(axes.row2);
}

/// A point of the ellipse, its size times `scale`, at the parameter t in radians.
inline Vec2 point_on(const optics::Outline& limb, double scale, double t) {
  const double angle = optics::radians(limb.angle), c = std::cos(angle), s = std::sin(angle);
  const double along = scale * limb.rx * std::cos(t), across = scale * limb.ry * std::sin(t);
  return {limb.centre.u + along * c - across * s, limb.centre.v + along * s + across * c};
}

/// A room of that kind around kBall, with a table and a spindle on request.
inline optics::SceneProxy scene_around_ball(optics::Scene::Room room, bool obstacles) {
  optics::Scene scene;
  scene.room = room;
  scene.centre = {150, 0, 300};
  scene.radius = 700;
  scene.point = {0, 0, -100};
  scene.normal = {0.1, 0, 2};
  scene.walls = {{-500, -400, -100}, {600, 500, 800}};
  if (obstacles) {
    scene.obstacles = {{{-300, -200, -100}, {400, 300, 200}}, {{200, 50, 300}, {280, 130, 800}}};
  }
  return optics::SceneProxy::make(scene, kBall).value();
}

}  // namespace orbwatch::tests
