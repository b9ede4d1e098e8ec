#pragma once

#include <libcamera/camera.h>

#include <memory>
#include <string>

#include "proc/image/result.h"

namespace orbwatch::hal {

/// How a sensor is read out. All zero leaves the choice to libcamera.
struct SensorMode {
  int width = 0;
  int height = 0;
  int bit_depth = 0;

  bool is_set() const { return width != 0 || height != 0 || bit_depth != 0; }
};

/// "1640x1232 10 bit"
std::string to_text(const SensorMode& mode);

/// Bits per sample of a raw format, packed or not, or 0 if it is none.
int raw_bit_depth(libcamera::PixelFormat format);

/// The modes that a camera offers, as text: "1640x1232 10 bit, 3280x2464 10 bit", or "none".
std::string sensor_modes_of(libcamera::Camera& camera);

/// A configuration for video, not validated yet, whose first stream is the picture and which asks
/// for `mode` if it is set. Error: the camera does not let anyone choose its mode.
Result<std::unique_ptr<libcamera::CameraConfiguration>> begin_configuration(
    libcamera::Camera& camera, const SensorMode& mode);

/// Whether a configuration of begin_configuration() still has the mode after validate() allowed it.
bool has_sensor_mode(const libcamera::CameraConfiguration& validated, const SensorMode& mode);

}  // namespace orbwatch::hal
