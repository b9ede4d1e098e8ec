#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "hal/camera.h"
#include "hal/v4l2/v4l2_device.h"

namespace orbwatch::hal {

/// A pixel format of V4L2 that is read, and what frames of it become.
struct V4l2Format {
  std::string_view name;  ///< as in the settings
  std::uint32_t fourcc;
  PixelFormat format;
};

/// In the order of preference of "auto": colour as the sensor gave it, colour as compressed, grey.
inline constexpr std::array kV4l2Formats{
    V4l2Format{"yuyv", V4L2_PIX_FMT_YUYV, PixelFormat::Yuyv},
    V4l2Format{"mjpeg", V4L2_PIX_FMT_MJPEG, PixelFormat::Rgb},
    V4l2Format{"grey", V4L2_PIX_FMT_GREY, PixelFormat::Grey},
    V4l2Format{"y16", V4L2_PIX_FMT_Y16, PixelFormat::Y16},
};

/// Larger pictures are neither asked for nor taken.
inline constexpr int kMaxV4l2Side = 16384;

/// What a device agreed to deliver.
struct V4l2Agreement {
  V4l2Format pixels;
  StreamFormat stream;
  std::size_t stride = 0;  ///< bytes from row to row; means nothing for MJPEG
};

/// The matrix and range by which a driver says that its YCbCr was made.
ColourSpace colour_space_of(const v4l2_pix_format& format);

/// Sets format, size and rate. `preference` is a name of kV4l2Formats or "auto": the first that has
/// the size at the rate asked for, else the first that has the size. The size is honoured or
/// refused with the list of what the device offers; the rate is the driver's choice nearest to it.
DeviceResult<V4l2Agreement> agree_on_format(V4l2Device& device, std::string_view preference,
                                            const StreamRequest& request);

}  // namespace orbwatch::hal
