#pragma once

#include <memory>
#include <vector>

#include "app/files/resolve.h"
#include "app/simulation/machine.h"
#include "hal/camera.h"

namespace orbwatch::app {

/// A camera that is configured.
struct OpenCamera {
  std::unique_ptr<hal::Camera> camera;
  hal::StreamFormat format;
};

/// Makes the camera that `settings` describe. Simulated ones look into `machine`.
std::unique_ptr<hal::Camera> make_camera(const CameraSettings& settings,
                                         const std::shared_ptr<const simulation::Machine>& machine);

/// Opens every camera of the site, with the controls of the first recipe. Errors name the camera.
Result<std::vector<OpenCamera>> open_cameras(const Resolved& site);

}  // namespace orbwatch::app
