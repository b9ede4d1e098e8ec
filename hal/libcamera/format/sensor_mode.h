#pragma once

#include <libcamera/camera.h>

#include <memory>
#include <string>

#include "hal/libcamera/libcamera_settings.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// "1640x1232 10 bit"
std::string to_text(const SensorMode& mode);

/// Bits per sample of a raw format, packed or not, or 0 for other formats.
int raw_bit_depth(libcamera::PixelFormat format);

/// A camera's modes as text: "1640x1232 10 bit, 3280x2464 10 bit", or "none".
std::string sensor_modes_of(libcamera::Camera& camera);

/// A configuration for video, not validated yet, whose first stream is the picture and which
/// requests `mode` if it is set. Error: the camera's mode cannot be chosen.
Result<std::unique_ptr<libcamera::CameraConfiguration>> begin_configuration(
    libcamera::Camera& camera, const SensorMode& mode);

/// Whether a configuration of begin_configuration() still has the mode after validate().
bool has_sensor_mode(const libcamera::CameraConfiguration& validated, const SensorMode& mode);

}  // namespace orbwatch::hal
