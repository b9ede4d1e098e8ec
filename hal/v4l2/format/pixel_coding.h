// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <linux/videodev2.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "hal/mosaic/mosaic.h"
#include "proc/image/pixel_format.h"

namespace orbwatch::hal {

/// Sample packings of drivers.
enum class Packing : std::uint8_t {
  None,       ///< layout of the PixelFormat: frames are forwarded in the driver's memory
  Mipi10,     ///< 4 samples in 5 bytes: the upper 8 bits of each, then their lower 2, first lowest
  Mipi12,     ///< 2 samples in 3 bytes: the upper 8 bits of each, then their lower 4
  BigEndian,  ///< 16 bit, high byte first
  Jpeg,       ///< one JPEG picture per frame
};

/// Supported pixel format of V4L2.
struct PixelCoding {
  std::string_view name;  ///< name in the settings
  std::uint32_t fourcc;
  PixelFormat format;  ///< format of its unpacked samples; luminance for a mosaic
  Packing packing = Packing::None;
  Mosaic mosaic = Mosaic::None;
  std::size_t memory_count = 1;  ///< number of memory planes
};

/// Missing in the headers of some kernels.
inline constexpr std::uint32_t kFourccY12p = v4l2_fourcc('Y', '1', '2', 'P');

/// Formats in the order of preference of "auto": uncompressed colour, compressed colour, mosaics,
/// then luminance, 8 bit first.
inline constexpr std::array kPixelCodings{
    PixelCoding{"yuyv", V4L2_PIX_FMT_YUYV, PixelFormat::Yuyv},
    PixelCoding{"uyvy", V4L2_PIX_FMT_UYVY, PixelFormat::Uyvy},
    PixelCoding{"nv12", V4L2_PIX_FMT_NV12, PixelFormat::Nv12},
    PixelCoding{"nv12m", V4L2_PIX_FMT_NV12M, PixelFormat::Nv12, Packing::None, Mosaic::None, 2},
    PixelCoding{"nv21", V4L2_PIX_FMT_NV21, PixelFormat::Nv21},
    PixelCoding{"nv21m", V4L2_PIX_FMT_NV21M, PixelFormat::Nv21, Packing::None, Mosaic::None, 2},
    PixelCoding{"yuv420", V4L2_PIX_FMT_YUV420, PixelFormat::I420},
    PixelCoding{"yuv420m", V4L2_PIX_FMT_YUV420M, PixelFormat::I420, Packing::None, Mosaic::None, 3},
    PixelCoding{"rgb24", V4L2_PIX_FMT_RGB24, PixelFormat::Rgb},
    PixelCoding{"bgr24", V4L2_PIX_FMT_BGR24, PixelFormat::Bgr},
    PixelCoding{"xbgr32", V4L2_PIX_FMT_XBGR32, PixelFormat::Bgra},
    PixelCoding{"abgr32", V4L2_PIX_FMT_ABGR32, PixelFormat::Bgra},
    PixelCoding{"bgr32", V4L2_PIX_FMT_BGR32, PixelFormat::Bgra},
    PixelCoding{"mjpeg", V4L2_PIX_FMT_MJPEG, PixelFormat::Nv12, Packing::Jpeg},
    PixelCoding{"jpeg", V4L2_PIX_FMT_JPEG, PixelFormat::Nv12, Packing::Jpeg},

    PixelCoding{"rggb8", V4L2_PIX_FMT_SRGGB8, PixelFormat::Grey, Packing::None, Mosaic::Rggb},
    PixelCoding{"grbg8", V4L2_PIX_FMT_SGRBG8, PixelFormat::Grey, Packing::None, Mosaic::Grbg},
    PixelCoding{"gbrg8", V4L2_PIX_FMT_SGBRG8, PixelFormat::Grey, Packing::None, Mosaic::Gbrg},
    PixelCoding{"bggr8", V4L2_PIX_FMT_SBGGR8, PixelFormat::Grey, Packing::None, Mosaic::Bggr},
    PixelCoding{"rggb10", V4L2_PIX_FMT_SRGGB10, PixelFormat::Y10, Packing::None, Mosaic::Rggb},
    PixelCoding{"grbg10", V4L2_PIX_FMT_SGRBG10, PixelFormat::Y10, Packing::None, Mosaic::Grbg},
    PixelCoding{"gbrg10", V4L2_PIX_FMT_SGBRG10, PixelFormat::Y10, Packing::None, Mosaic::Gbrg},
    PixelCoding{"bggr10", V4L2_PIX_FMT_SBGGR10, PixelFormat::Y10, Packing::None, Mosaic::Bggr},
    PixelCoding{"rggb10p", V4L2_PIX_FMT_SRGGB10P, PixelFormat::Y10, Packing::Mipi10, Mosaic::Rggb},
    PixelCoding{"grbg10p", V4L2_PIX_FMT_SGRBG10P, PixelFormat::Y10, Packing::Mipi10, Mosaic::Grbg},
    PixelCoding{"gbrg10p", V4L2_PIX_FMT_SGBRG10P, PixelFormat::Y10, Packing::Mipi10, Mosaic::Gbrg},
    PixelCoding{"bggr10p", V4L2_PIX_FMT_SBGGR10P, PixelFormat::Y10, Packing::Mipi10, Mosaic::Bggr},
    PixelCoding{"rggb12", V4L2_PIX_FMT_SRGGB12, PixelFormat::Y12, Packing::None, Mosaic::Rggb},
    PixelCoding{"grbg12", V4L2_PIX_FMT_SGRBG12, PixelFormat::Y12, Packing::None, Mosaic::Grbg},
    PixelCoding{"gbrg12", V4L2_PIX_FMT_SGBRG12, PixelFormat::Y12, Packing::None, Mosaic::Gbrg},
    PixelCoding{"bggr12", V4L2_PIX_FMT_SBGGR12, PixelFormat::Y12, Packing::None, Mosaic::Bggr},
    PixelCoding{"rggb12p", V4L2_PIX_FMT_SRGGB12P, PixelFormat::Y12, Packing::Mipi12, Mosaic::Rggb},
    PixelCoding{"grbg12p", V4L2_PIX_FMT_SGRBG12P, PixelFormat::Y12, Packing::Mipi12, Mosaic::Grbg},
    PixelCoding{"gbrg12p", V4L2_PIX_FMT_SGBRG12P, PixelFormat::Y12, Packing::Mipi12, Mosaic::Gbrg},
    PixelCoding{"bggr12p", V4L2_PIX_FMT_SBGGR12P, PixelFormat::Y12, Packing::Mipi12, Mosaic::Bggr},
    PixelCoding{"rggb16", V4L2_PIX_FMT_SRGGB16, PixelFormat::Y16, Packing::None, Mosaic::Rggb},
    PixelCoding{"grbg16", V4L2_PIX_FMT_SGRBG16, PixelFormat::Y16, Packing::None, Mosaic::Grbg},
    PixelCoding{"gbrg16", V4L2_PIX_FMT_SGBRG16, PixelFormat::Y16, Packing::None, Mosaic::Gbrg},
    PixelCoding{"bggr16", V4L2_PIX_FMT_SBGGR16, PixelFormat::Y16, Packing::None, Mosaic::Bggr},

    PixelCoding{"grey", V4L2_PIX_FMT_GREY, PixelFormat::Grey},
    PixelCoding{"y16", V4L2_PIX_FMT_Y16, PixelFormat::Y16},
    PixelCoding{"y16_be", V4L2_PIX_FMT_Y16_BE, PixelFormat::Y16, Packing::BigEndian},
    PixelCoding{"y12", V4L2_PIX_FMT_Y12, PixelFormat::Y12},
    PixelCoding{"y12p", kFourccY12p, PixelFormat::Y12, Packing::Mipi12},
    PixelCoding{"y10", V4L2_PIX_FMT_Y10, PixelFormat::Y10},
    PixelCoding{"y10p", V4L2_PIX_FMT_Y10P, PixelFormat::Y10, Packing::Mipi10},
};

/// 16 bit words that a thermal camera sends as YUYV, because a UVC device of its time could not
/// declare them: not in the table, since only the settings distinguish them from a picture.
inline constexpr PixelCoding kWordsAsYuyv{"y16", V4L2_PIX_FMT_YUYV, PixelFormat::Y16};

/// Values that the settings allow: "auto" and the names above.
inline constexpr auto kPixelCodingNames = [] {
  std::array<std::string_view, kPixelCodings.size() + 1> names{"auto"};
  for (std::size_t i = 0; i < kPixelCodings.size(); ++i) names[i + 1] = kPixelCodings[i].name;
  return names;
}();

/// The coding with a four-character code, or nullptr.
const PixelCoding* find_coding(std::uint32_t fourcc);

/// Format of the frames: with `colour`, a mosaic becomes Bgr of 8 bit and a JPEG picture Nv12;
/// without it a mosaic is kept and a JPEG picture becomes its luminance.
PixelFormat frame_format(const PixelCoding& coding, bool colour);

/// True when the size is a multiple of the coding's pixel groups and Bayer pattern.
bool is_whole(const PixelCoding& coding, bool colour, int width, int height);

/// Bytes of a row of the first plane in the driver's packing, without padding.
std::size_t packed_row_bytes(const PixelCoding& coding, int width);

}  // namespace orbwatch::hal
