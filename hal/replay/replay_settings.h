// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/back_end.h"
#include "hal/camera.h"
#include "hal/fault.h"
#include "proc/settings/settings.h"

namespace orbwatch::hal {

/// Recording that a replay camera plays, and its settings.
struct ReplaySettings {
  static constexpr std::string_view kName = "replay";
  static constexpr BackEndFacts kFacts{.origin = CameraOrigin::Files, .address_key = "source"};

  std::string name;              ///< becomes CameraInfo::id
  std::filesystem::path source;  ///< a folder of JPEG or PNG pictures, one, a recording, or a video
  double frame_rate = 0;         ///< per second; 0: the video's own, 30 for a folder
  bool loop = true;              ///< false: after the last picture the camera is unplugged
  std::vector<ScriptedFault> faults = {};

  /// Plays once.
  static ReplaySettings at(const std::string& address) {
    ReplaySettings settings;
    settings.source = address;
    settings.loop = false;
    return settings;
  }
  std::string address() const { return source.string(); }
  static std::optional<PixelFormat> stated_format() { return std::nullopt; }
};

/// Visits all settings except those from the camera's context.
template <class Visitor>
void visit(Visitor& v, ReplaySettings& settings) {
  v.required("source", settings.source,
             "Folder of numbered JPEG or PNG pictures, one picture, an MCAP recording, which has "
             "pictures of a camera of this name, or a video, which needs the package "
             "orbwatch-camera-video");
  v.optional("loop", settings.loop, "Restart from the first picture after the last one");
}

std::unique_ptr<Camera> make_camera(ReplaySettings settings, const CameraContext& context);

}  // namespace orbwatch::hal
