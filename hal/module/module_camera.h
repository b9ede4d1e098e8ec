// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/camera.h"
#include "hal/inventory.h"

namespace orbwatch::hal {

/// Makes a camera of a module, for the back-end's make_camera(); `settings` is its settings struct.
/// Without the module it makes a camera that is never connected and reports the reason.
/// Thread-safe.
std::unique_ptr<Camera> make_module_camera(std::string_view back_end, const void* settings,
                                           const CameraContext& context);

/// Connected cameras of a back-end. Empty when its module is not installed; one entry with the
/// reason when the module cannot be used. Thread-safe.
std::vector<CameraEntry> list_module_cameras(std::string_view back_end);

/// Connected cameras of all modules.
std::vector<CameraEntry> list_module_cameras();

/// Library of each module and its version, or the reason why it is missing; of kVideoModule, which
/// is not loaded for this, only whether it is installed. Thread-safe.
std::vector<std::pair<std::string, std::string>> module_versions();

}  // namespace orbwatch::hal
