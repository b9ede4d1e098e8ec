// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/genicam_settings.h"
#include "hal/module/module_camera.h"

namespace orbwatch::hal {

std::unique_ptr<Camera> make_camera(const GenicamSettings& settings, const CameraContext& context) {
  return make_module_camera(GenicamSettings::kName, &settings, context);
}

}  // namespace orbwatch::hal
