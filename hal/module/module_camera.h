#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/camera.h"
#include "hal/inventory.h"

namespace orbwatch::hal {

/// A camera of a module, for the back-end's make_camera(); `settings` is its settings struct.
/// Without the module a camera that is never there and says why. Thread-safe.
std::unique_ptr<Camera> make_module_camera(std::string_view back_end, const void* settings,
                                           const CameraContext& context);

/// The connected cameras of a back-end. Empty when its module is not installed; one entry with the
/// reason when the module cannot be used. Thread-safe.
std::vector<CameraEntry> list_module_cameras(std::string_view back_end);

/// The same of all modules.
std::vector<CameraEntry> list_module_cameras();

/// The library of each module and its version, or why it has none. Thread-safe.
std::vector<std::pair<std::string, std::string>> module_versions();

}  // namespace orbwatch::hal
