#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "hal/camera.h"
#include "hal/v4l2/format/pixel_coding.h"
#include "proc/settings/settings.h"

namespace orbwatch::hal {

/// Which V4L2 device, and how.
struct V4l2Settings {
  static constexpr std::string_view kName = "v4l2";

  /// A device node, or another name that find_v4l2_device() knows. Links in /dev/v4l/by-id or
  /// by-path and places on a bus name the same camera after it was plugged in again, while
  /// /dev/video0 may then be another.
  std::string device = "/dev/video0";
  std::string pixel_format = "auto";  ///< one of kPixelCodingNames
  bool colour = true;                 ///< see frame_format()
};

template <class Visitor>
void visit(Visitor& v, V4l2Settings& settings) {
  v.required("device", settings.device,
             "Device node, or what survives replugging: a link in /dev/v4l/by-id or by-path, or "
             "the place on a bus (usb-0000:00:14.0-1)");
  v.optional("pixel_format", settings.pixel_format, kPixelCodingNames,
             "What the camera sends; auto: the first that it has in the size and at the rate");
  v.optional("colour", settings.colour,
             "Make colour of a sensor's mosaic and of MJPEG; else the mosaic stays as it is, and "
             "of MJPEG the luminance");
}

std::unique_ptr<Camera> make_camera(const V4l2Settings& settings, const CameraContext& context);

}  // namespace orbwatch::hal
