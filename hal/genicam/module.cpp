// SPDX-License-Identifier: Apache-2.0
#include <arv.h>

#include "hal/genicam/genicam_camera.h"
#include "hal/genicam/genicam_list.h"
#include "hal/genicam/genicam_settings.h"
#include "hal/module/camera_module.h"

namespace orbwatch::hal {
namespace {

std::string aravis_version() {
  return std::to_string(arv_get_major_version()) + "." + std::to_string(arv_get_minor_version()) +
         "." + std::to_string(arv_get_micro_version());
}

constexpr CameraModule kModule{
    kCameraModuleInterface,
    ORBWATCH_MODULE_BUILD_ID,
    GenicamSettings::kName,
    [](const void* settings, const CameraContext&) -> std::unique_ptr<Camera> {
      return std::make_unique<GenicamCamera>(*static_cast<const GenicamSettings*>(settings));
    },
    list_genicam_cameras,
    aravis_version,
};

}  // namespace
}  // namespace orbwatch::hal

extern "C" [[gnu::visibility("default")]] const orbwatch::hal::CameraModule*
orbwatch_camera_module() {
  return &orbwatch::hal::kModule;
}
