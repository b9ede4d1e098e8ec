// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "hal/camera.h"
#include "hal/inventory.h"
#include "hal/replay/recording.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Version of the descriptor below. A change of CameraModule increments it; changes of the classes
/// that cross the boundary are detected by the build id.
inline constexpr int kCameraModuleInterface = 2;

/// Description that a module exports. The first two members never move: they are read before it is
/// known whether the rest is understood. All texts and functions live as long as the program,
/// unless it refuses the module.
struct CameraModule {
  int interface_version = kCameraModuleInterface;
  /// Identifies the headers that the module was compiled with: ORBWATCH_MODULE_BUILD_ID.
  const char* build_id = nullptr;
  /// Word of the back-end in a configuration, or kVideoModule.
  std::string_view back_end;
  /// `settings` is the back-end's own settings struct. Thread-safe. Null for kVideoModule, as the
  /// two that follow.
  std::unique_ptr<Camera> (*make_camera)(const void* settings,
                                         const CameraContext& context) = nullptr;
  /// Connected cameras; one entry with the reason when they cannot be listed. Disturbs no stream.
  /// Thread-safe.
  std::vector<CameraEntry> (*list_cameras)() = nullptr;
  /// Version of the library in use. Thread-safe.
  std::string (*library_version)() = nullptr;
  /// Opens a video for the back-end replay; null except for kVideoModule. Errors: not a video, its
  /// first picture cannot be decoded. Thread-safe.
  Result<std::unique_ptr<Recording>> (*open_recording)(const std::filesystem::path& file,
                                                       bool loop) = nullptr;
};

/// Name of the function with C linkage that each module exports: `const CameraModule*
/// orbwatch_camera_module()`.
inline constexpr const char* kCameraModuleEntry = "orbwatch_camera_module";
using CameraModuleEntry = const CameraModule* (*)();

}  // namespace orbwatch::hal
