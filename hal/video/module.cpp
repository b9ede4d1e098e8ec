// SPDX-License-Identifier: Apache-2.0
#include "hal/module/camera_module.h"
#include "hal/module/module_list.h"
#include "hal/video/video_file.h"

namespace orbwatch::hal {
namespace {

constexpr CameraModule kModule{.build_id = ORBWATCH_MODULE_BUILD_ID,
                               .back_end = kVideoModule,
                               .open_recording = VideoFile::open};

}  // namespace
}  // namespace orbwatch::hal

extern "C" [[gnu::visibility("default")]] const orbwatch::hal::CameraModule*
orbwatch_camera_module() {
  return &orbwatch::hal::kModule;
}
