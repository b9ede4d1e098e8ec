#pragma once

#include <memory>

#include "app/config/configuration.h"
#include "app/simulation/machine.h"
#include "hal/camera.h"

namespace orbwatch::app {

/// The list of camera back-ends: makes the camera that `settings` describe. Simulated ones look
/// into `machine`.
std::unique_ptr<hal::Camera> make_camera(const CameraSettings& settings,
                                         const std::shared_ptr<const simulation::Machine>& machine);

}  // namespace orbwatch::app
