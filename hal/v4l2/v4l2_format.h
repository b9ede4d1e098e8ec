#pragma once

#include <string>
#include <string_view>

#include "hal/camera.h"
#include "hal/v4l2/driver_layout.h"
#include "hal/v4l2/pixel_coding.h"
#include "hal/v4l2/v4l2_device.h"

namespace orbwatch::hal {

/// What is wanted of a device's pictures.
struct FormatWish {
  std::string_view pixel_format = "auto";  ///< one of kPixelCodingNames
  bool colour = true;                      ///< see frame_format()
  StreamRequest stream;
};

/// What a device agreed to deliver, and what its frames become.
struct V4l2Agreement {
  PixelCoding coding;
  DriverLayout layout;
  StreamFormat stream;

  /// True when frames are the driver's memory as it is.
  bool is_handed_on() const {
    return coding.packing == Packing::None && stream.format == coding.format;
  }
};

/// Sets format, size and rate. With "auto" it is the first of kPixelCodings that has the size at
/// the rate asked for, else the first that has the size. The size is honoured or refused with the
/// list of what the device offers; the rate is the driver's choice nearest to it.
DeviceResult<V4l2Agreement> agree_on_format(V4l2Device& device, const FormatWish& wish);

/// A four-character code as people write it: "YUYV", "Y16-BE" for the big-endian ones.
std::string fourcc_text(std::uint32_t fourcc);

/// "640x480", or "2x2..4096x2160" for a range.
std::string size_text(const FrameSizeOffer& size);

}  // namespace orbwatch::hal
