// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <libcamera/color_space.h>
#include <libcamera/formats.h>
#include <libcamera/pixel_format.h>

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string_view>

#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::hal {

/// Supported pixel format of libcamera, and the format of its frames.
struct LibcameraFormat {
  std::string_view name;  ///< name in libcamera and in the settings
  libcamera::PixelFormat code;
  PixelFormat format;
  bool v_before_u = false;  ///< order of separate chroma planes
};

/// Formats in the order of preference of "auto": colour of an ISP, then grey, deep before shallow.
/// libcamera names RGB formats like DRM, by the bits of a little-endian word: its RGB888 is B, G, R
/// in memory.
inline constexpr std::array kLibcameraFormats{
    LibcameraFormat{"NV12", libcamera::formats::NV12, PixelFormat::Nv12},
    LibcameraFormat{"NV21", libcamera::formats::NV21, PixelFormat::Nv21},
    LibcameraFormat{"YUV420", libcamera::formats::YUV420, PixelFormat::I420},
    LibcameraFormat{"YVU420", libcamera::formats::YVU420, PixelFormat::I420, true},
    LibcameraFormat{"YUYV", libcamera::formats::YUYV, PixelFormat::Yuyv},
    LibcameraFormat{"UYVY", libcamera::formats::UYVY, PixelFormat::Uyvy},
    LibcameraFormat{"BGR888", libcamera::formats::BGR888, PixelFormat::Rgb},
    LibcameraFormat{"RGB888", libcamera::formats::RGB888, PixelFormat::Bgr},
    LibcameraFormat{"XRGB8888", libcamera::formats::XRGB8888, PixelFormat::Bgra},
    LibcameraFormat{"ARGB8888", libcamera::formats::ARGB8888, PixelFormat::Bgra},
    // R16 has no name in libcamera 0.0.3.
    LibcameraFormat{"R16", libcamera::PixelFormat(0x20363152 /* "R16 " */), PixelFormat::Y16},
    LibcameraFormat{"R12", libcamera::formats::R12, PixelFormat::Y12},
    LibcameraFormat{"R10", libcamera::formats::R10, PixelFormat::Y10},
    LibcameraFormat{"R8", libcamera::formats::R8, PixelFormat::Grey},
};

/// The entry of kLibcameraFormats for a code, or nullptr.
const LibcameraFormat* find_format(libcamera::PixelFormat code);

/// Colour space that libcamera declares, else BT.601 of limited range, V4L2's default. Nullopt for
/// an unsupported YCbCr encoding (BT.2020).
std::optional<ColourSpace> colour_space_of(const std::optional<libcamera::ColorSpace>& space,
                                           PixelFormat format);

/// Describes the picture of `format` in `planes`, in libcamera's order; one plane may contain those
/// that follow. `stride` is the first plane's, bytes. Error: a plane is too short. Reentrant.
Result<Picture> lay_out(const LibcameraFormat& format, int width, int height, std::size_t stride,
                        std::span<const std::span<const std::byte>> planes);

}  // namespace orbwatch::hal
