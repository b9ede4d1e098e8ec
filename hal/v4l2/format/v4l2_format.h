// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "hal/camera.h"
#include "hal/v4l2/device/v4l2_device.h"
#include "hal/v4l2/format/driver_format.h"
#include "hal/v4l2/format/pixel_coding.h"

namespace orbwatch::hal {

/// Pictures that are requested from a device.
struct FormatRequest {
  std::string_view pixel_format = "auto";  ///< one of kPixelCodingNames
  bool colour = true;                      ///< see frame_format()
  StreamRequest stream;
  /// Height of the device's frames, px; 0: the picture's. The picture consists of stream.height of
  /// their rows, all if that is 0, from first_row on.
  int frame_height = 0;
  int first_row = 0;
  /// Its samples are counts of temperature: "y16" then also means kWordsAsYuyv, if there is no Y16.
  bool is_radiometric = false;
};

/// Format that a device will deliver, and the format of its decoded frames.
struct NegotiatedFormat {
  PixelCoding coding;
  DriverLayout layout;
  StreamFormat stream;

  /// True when frames are forwarded in the driver's memory.
  bool is_zero_copy() const {
    return coding.packing == Packing::None && stream.format == coding.format;
  }
};

/// Sets format, size and rate. "auto" selects the first of kPixelCodings with the requested size
/// and rate, else the first with the size. The size is honoured, or refused with a list of the
/// offers and a remedy; the rate is the driver's nearest. JPEG pictures cannot be cropped.
DeviceResult<NegotiatedFormat> negotiate_format(V4l2Device& device, const FormatRequest& wanted);

/// A four-character code as text: "YUYV", "Y16-BE" for big-endian formats.
std::string fourcc_text(std::uint32_t fourcc);

/// Text such as "640x480", or "2x2..4096x2160" for a range.
std::string size_text(const FrameSizeOffer& size);

}  // namespace orbwatch::hal
