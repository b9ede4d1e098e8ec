// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "hal/back_end.h"
#include "hal/camera.h"
#include "hal/v4l2/format/pixel_coding.h"
#include "proc/image/picture.h"
#include "proc/settings/settings.h"

namespace orbwatch::hal {

/// Selection and settings of a V4L2 device.
struct V4l2Settings {
  static constexpr std::string_view kName = "v4l2";
  static constexpr BackEndFacts kFacts{
      .origin = CameraOrigin::Kernel,
      .address_key = "device",
      .takes_size_of_rig = true,
      .radiometric_advice =
          "state pixel_format = \"y16\", also for 16 bit words that the driver "
          "calls YUYV"};

  /// Device node, or another name that find_v4l2_device() resolves. Links in /dev/v4l/by-id or
  /// by-path and places on a bus name the same camera after it was plugged in again, while
  /// /dev/video0 may then be another.
  std::string device = "/dev/video0";
  std::string pixel_format = "auto";  ///< one of kPixelCodingNames
  bool colour = true;                 ///< see frame_format()
  int frame_height = 0;               ///< see FormatRequest
  int first_row = 0;                  ///< see FormatRequest
  bool is_radiometric = false;        ///< no key: the site states kelvin_per_count

  static V4l2Settings at(std::string address) { return {.device = std::move(address)}; }
  std::string address() const { return device; }
  std::optional<PixelFormat> stated_format() const;
};

template <class Visitor>
void visit(Visitor& v, V4l2Settings& settings) {
  v.required("device", settings.device,
             "Device node, or a name that survives replugging: a link in /dev/v4l/by-id or "
             "by-path, or the bus position (usb-0000:00:14.0-1)");
  v.optional("pixel_format", settings.pixel_format, kPixelCodingNames,
             "Pixel format that the camera sends; auto: the first one that it offers at this size "
             "and rate; y16 with kelvin_per_count: also the 16-bit words of a thermal camera that "
             "declares them as YUYV");
  v.optional("colour", settings.colour,
             "Demosaic and decode to colour; false: the mosaic stays as it is, and MJPEG is "
             "decoded to luminance");
  v.optional(
      "frame_height", settings.frame_height, Range::between(1, kMaxSide),
      "Height of the frames that the camera sends, px, if the picture is only a part of them: "
      "below another picture, or beside telemetry lines; default: the picture's height");
  v.optional("first_row", settings.first_row, Range::between(0, kMaxSide - 1),
             "First row of the picture in the camera's frames");
  v.require(settings.first_row == 0 || settings.first_row < settings.frame_height, "first_row",
            "needs a frame_height that is larger than first_row");
}

/// Nullopt: the format is chosen when the camera is opened.
inline std::optional<PixelFormat> V4l2Settings::stated_format() const {
  const auto coding = std::ranges::find(kPixelCodings, pixel_format, &PixelCoding::name);
  if (coding == kPixelCodings.end()) return std::nullopt;
  return frame_format(*coding, colour);
}

std::unique_ptr<Camera> make_camera(V4l2Settings settings, const CameraContext& context);

}  // namespace orbwatch::hal
