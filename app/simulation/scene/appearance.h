// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "app/simulation/scene/static_scene.h"
#include "app/simulation/tracing/tone.h"

namespace orbwatch::app::simulation {

/// Appearance of a point of the machine to colour and thermal cameras.
struct Appearance {
  Light light;
  double temperature = 0;  ///< degC
};

/// Appearance of the static scene at the end of `ray`: walls with plates of their own colours and
/// names, straight joints every 100 mm, a lamp in the ceiling; a table with slots along X; the
/// workpiece, whose top has its settings' temperature. Reentrant.
Appearance appearance_of(const MachineSettings& settings, const Ray& ray, const StaticHit& hit);

/// Colour of the nozzle's surface at `point` with the outward `normal`. Reentrant.
Light nozzle_light(const MachineSettings& settings, const Vec3& point, const Vec3& normal,
                   bool cone);

}  // namespace orbwatch::app::simulation
