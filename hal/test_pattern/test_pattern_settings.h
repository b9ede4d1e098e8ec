// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/back_end.h"
#include "hal/camera.h"
#include "hal/fault.h"
#include "hal/pixel_format_words.h"
#include "proc/image/pixel_format.h"
#include "proc/settings/settings.h"

namespace orbwatch::hal {

/// Camera whose pictures cost no processor time; without a device (GenICam TestPattern).
struct TestPatternSettings {
  static constexpr std::string_view kName = "test_pattern";
  static constexpr BackEndFacts kFacts{.origin = CameraOrigin::Process, .needs_size = true};

  std::string name;  ///< becomes CameraInfo::id
  PixelFormat pixel_format = PixelFormat::Grey;
  int width = 0;          ///< used unless configure() requests another size
  int height = 0;         ///< used unless configure() requests another size
  double frame_rate = 0;  ///< per second; 0: kTestPatternRate
  bool numbered = false;  ///< see paint_number()
  std::vector<ScriptedFault> faults = {};

  std::optional<PixelFormat> stated_format() const { return pixel_format; }
};

inline constexpr double kTestPatternRate = 30;

/// Visits all settings except those from the camera's context.
template <class Visitor>
void visit(Visitor& v, TestPatternSettings& settings) {
  v.required("pixel_format", settings.pixel_format, kPixelFormatWords,
             "Pixel format of the frames");
  v.optional("numbered", settings.numbered,
             "Paint the frame number into each frame, to identify it");
}

std::unique_ptr<Camera> make_camera(TestPatternSettings settings, const CameraContext& context);

}  // namespace orbwatch::hal
