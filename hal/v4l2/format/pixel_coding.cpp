// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/format/pixel_coding.h"

#include <algorithm>

namespace orbwatch::hal {
namespace {

/// Number of pixels of a row that share bytes or chroma, a power of two.
int column_group(const PixelCoding& coding, const PixelFormatInfo& frame) {
  if (coding.packing == Packing::Mipi10) return 4;
  const bool pairs = coding.packing == Packing::Mipi12 || coding.mosaic != Mosaic::None ||
                     frame.format == PixelFormat::Yuyv || frame.format == PixelFormat::Uyvy;
  return pairs ? 2 : 1 << frame.planes[1].shift_x;
}

}  // namespace

const PixelCoding* find_coding(std::uint32_t fourcc) {
  const auto* const found = std::ranges::find(kPixelCodings, fourcc, &PixelCoding::fourcc);
  return found == kPixelCodings.end() ? nullptr : found;
}

PixelFormat frame_format(const PixelCoding& coding, bool colour) {
  if (colour && coding.mosaic != Mosaic::None) return PixelFormat::Bgr;
  if (!colour && coding.packing == Packing::Jpeg) return PixelFormat::Grey;
  return coding.format;
}

bool is_whole(const PixelCoding& coding, bool colour, int width, int height) {
  const PixelFormatInfo& frame = info(frame_format(coding, colour));
  const int rows = coding.mosaic != Mosaic::None ? 2 : 1 << frame.planes[1].shift_y;
  return width > 0 && height > 0 && width % column_group(coding, frame) == 0 && height % rows == 0;
}

std::size_t packed_row_bytes(const PixelCoding& coding, int width) {
  const auto pixels = static_cast<std::size_t>(width);
  switch (coding.packing) {
    case Packing::Mipi10:
      return pixels / 4 * 5;
    case Packing::Mipi12:
      return pixels / 2 * 3;
    case Packing::Jpeg:
      return 0;
    case Packing::None:
    case Packing::BigEndian:
      break;
  }
  return static_cast<std::size_t>(row_bytes(coding.format, width));
}

}  // namespace orbwatch::hal
