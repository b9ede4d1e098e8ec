// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "hal/back_end.h"
#include "hal/camera.h"
#include "hal/inventory.h"
#include "proc/image/picture.h"
#include "proc/settings/settings.h"

namespace orbwatch::hal {

/// Readout mode of a sensor. All zero leaves the choice to libcamera.
struct SensorMode {
  int width = 0;
  int height = 0;
  int bit_depth = 0;

  bool is_set() const { return width != 0 || height != 0 || bit_depth != 0; }
};

/// Selection and settings of a camera of libcamera. Needs no header of libcamera.
struct LibcameraSettings {
  static constexpr std::string_view kName = "libcamera";
  static constexpr BackEndFacts kFacts{.origin = CameraOrigin::Module,
                                       .address_key = "camera",
                                       .has_board_sensors = true,
                                       .shares_usb = true};

  /// libcamera's id (`cam --list`), or a part of id or sensor model that only one camera has.
  std::string camera;
  std::string pixel_format = "auto";  ///< "auto" or a name of kLibcameraFormats
  SensorMode sensor_mode = {};        ///< if set, required

  static LibcameraSettings at(std::string address) { return {.camera = std::move(address)}; }
  std::string address() const { return camera; }
  bool accepts(const CameraEntry& entry) const {
    return entry.problem.empty() && (entry.id.find(camera) != std::string::npos ||
                                     entry.model.find(camera) != std::string::npos);
  }
  static std::optional<PixelFormat> stated_format() { return std::nullopt; }
};

template <class Visitor>
void visit(Visitor& v, LibcameraSettings& settings) {
  SensorMode& mode = settings.sensor_mode;
  const Range side = Range::between(1, kMaxSide);
  v.required("camera", settings.camera,
             "libcamera id, or a part of an id or sensor model that matches only one camera");
  v.optional("pixel_format", settings.pixel_format,
             "auto, or a libcamera name: NV12, YUV420, R10, ...");
  v.optional("sensor_width", mode.width, side,
             "Width of the required sensor mode, px; default: libcamera chooses the mode");
  v.optional("sensor_height", mode.height, side, "Height of the required sensor mode, px");
  v.optional("sensor_bit_depth", mode.bit_depth, Range::between(1, 32),
             "Bit depth of the required sensor mode, bits per sample");
  v.require((mode.width == 0) == (mode.height == 0) && (mode.width == 0) == (mode.bit_depth == 0),
            "sensor_width", "a sensor mode needs sensor_width, sensor_height and sensor_bit_depth");
}

std::unique_ptr<Camera> make_camera(const LibcameraSettings& settings,
                                    const CameraContext& context);

}  // namespace orbwatch::hal
