// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>

#include "app/simulation/machine.h"
#include "app/simulation/tracing/pinhole.h"
#include "proc/optics/ball_projection.h"
#include "proc/optics/scene_proxy.h"
#include "proc/signals/region.h"

namespace orbwatch::app::daemon {

inline optics::Box box(const simulation::Box& body) { return {body.lo, body.hi}; }

/// Static parts of the machine, as a rig would state them.
inline optics::Scene scene_of(const simulation::MachineSettings& machine) {
  optics::Scene scene;
  scene.room = optics::Scene::Room::Box;
  scene.walls = box(machine.enclosure);
  scene.obstacles = {box(machine.table), box(machine.workpiece)};
  return scene;
}

inline signals::RegionScene region_scene_of(const simulation::MachineSettings& machine) {
  const optics::Ball ball{machine.ball.centre, machine.ball.radius};
  return {ball, optics::SceneProxy::make(scene_of(machine), ball).value()};
}

/// Camera as its calibration would state it, in a machine whose geometry is known.
inline optics::BallProjection projection_of(const simulation::Pinhole& pinhole,
                                            const signals::RegionScene& scene) {
  const optics::Intrinsics intrinsics{
      pinhole.width, pinhole.height, pinhole.focal_length,     pinhole.focal_length,
      pinhole.cx(),  pinhole.cy(),   optics::Distortion::None, {}};
  return optics::BallProjection::make(optics::BallModel::Kind::Exact,
                                      {optics::Lens::make(intrinsics).value(),
                                       {pinhole.rotation, pinhole.position},
                                       std::nullopt},
                                      scene.ball, scene.proxy)
      .value();
}

}  // namespace orbwatch::app::daemon
