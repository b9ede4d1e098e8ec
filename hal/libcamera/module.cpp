// SPDX-License-Identifier: Apache-2.0
#include <libcamera/camera_manager.h>

#include "hal/libcamera/libcamera_camera.h"
#include "hal/libcamera/libcamera_list.h"
#include "hal/libcamera/libcamera_settings.h"
#include "hal/module/camera_module.h"

namespace orbwatch::hal {
namespace {

constexpr CameraModule kModule{
    kCameraModuleInterface,
    ORBWATCH_MODULE_BUILD_ID,
    LibcameraSettings::kName,
    [](const void* settings, const CameraContext&) -> std::unique_ptr<Camera> {
      return std::make_unique<LibcameraCamera>(*static_cast<const LibcameraSettings*>(settings));
    },
    list_libcamera_cameras,
    [] { return libcamera::CameraManager::version(); },
};

}  // namespace
}  // namespace orbwatch::hal

extern "C" [[gnu::visibility("default")]] const orbwatch::hal::CameraModule*
orbwatch_camera_module() {
  return &orbwatch::hal::kModule;
}
