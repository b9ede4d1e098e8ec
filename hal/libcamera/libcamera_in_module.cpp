// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/libcamera_settings.h"
#include "hal/module/module_camera.h"

namespace orbwatch::hal {

std::unique_ptr<Camera> make_camera(const LibcameraSettings& settings,
                                    const CameraContext& context) {
  return make_module_camera(LibcameraSettings::kName, &settings, context);
}

}  // namespace orbwatch::hal
