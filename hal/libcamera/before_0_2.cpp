// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/camera_manager.h"
#include "hal/libcamera/format/camera_configuration.h"

namespace orbwatch::hal {
namespace {

constexpr unsigned kRawStream = 1;

}  // namespace

/// libcamera before 0.2 does not list a camera's nodes.
bool has_lost_its_nodes(const libcamera::Camera&) { return false; }

/// libcamera before 0.2: a second, raw stream has the size and depth of the sensor's mode. Its
/// frames are not requested; pipelines fill buffers of their own.
Result<std::unique_ptr<libcamera::CameraConfiguration>> begin_configuration(
    libcamera::Camera& camera, const SensorMode& mode) {
  using libcamera::StreamRole;
  if (!mode.is_set()) {
    auto configuration = camera.generateConfiguration({StreamRole::VideoRecording});
    if (!configuration || configuration->empty()) return fail("has no stream for video");
    return configuration;
  }
  auto configuration = camera.generateConfiguration({StreamRole::VideoRecording, StreamRole::Raw});
  if (!configuration || configuration->size() <= kRawStream) {
    return fail("its sensor mode cannot be chosen");
  }
  libcamera::StreamConfiguration& raw = configuration->at(kRawStream);
  for (const auto& format : raw.formats().pixelformats()) {
    if (raw_bit_depth(format) == mode.bit_depth) {
      raw.pixelFormat = format;
      break;
    }
  }
  raw.size = libcamera::Size(static_cast<unsigned>(mode.width), static_cast<unsigned>(mode.height));
  return configuration;
}

bool has_sensor_mode(const libcamera::CameraConfiguration& validated, const SensorMode& mode) {
  if (!mode.is_set()) return true;
  if (validated.size() <= kRawStream) return false;
  const libcamera::StreamConfiguration& raw = validated.at(kRawStream);
  return raw.size == libcamera::Size(static_cast<unsigned>(mode.width),
                                     static_cast<unsigned>(mode.height)) &&
         raw_bit_depth(raw.pixelFormat) == mode.bit_depth;
}

}  // namespace orbwatch::hal
