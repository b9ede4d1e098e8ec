#pragma once

#include "app/simulation/static_scene.h"
#include "app/simulation/tone.h"

namespace orbwatch::app::simulation {

/// How a point of the machine looks to a colour and to a thermal camera.
struct Appearance {
  Light light;
  double temperature = 0;  ///< degC
};

/// The look of what stands still, where `ray` ends on it: walls of plates in a colour and with a
/// name of their own, joints in straight lines every 100 mm, a lamp in the ceiling; a table with
/// slots along X; the workpiece at its settings' temperature all over its top. Reentrant.
Appearance appearance_of(const MachineSettings& settings, const Ray& ray, const StaticHit& hit);

/// The look of the nozzle's surface at `point` with the outward `normal`. Reentrant.
Light nozzle_light(const MachineSettings& settings, const Vec3& point, const Vec3& normal,
                   bool cone);

}  // namespace orbwatch::app::simulation
