// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/format/genicam_format.h"

#include <algorithm>

namespace orbwatch::hal {
namespace {

/// Samples that share bytes, and the bytes of such a group.
struct Group {
  std::size_t samples;
  std::size_t bytes;
};

Group group_of(SamplePacking packing) {
  switch (packing) {
    case SamplePacking::None:
      break;
    case SamplePacking::Lsb10:
      return {4, 5};
    case SamplePacking::Lsb14:
      return {4, 7};
    case SamplePacking::Lsb12:
    case SamplePacking::Gev10:
    case SamplePacking::Gev12:
      return {2, 3};
  }
  return {1, 0};
}

template <class Key>
const GenicamFormat* find(const Key& key, Key GenicamFormat::*member) {
  const auto* const found = std::ranges::find(kGenicamFormats, key, member);
  return found == kGenicamFormats.end() ? nullptr : found;
}

}  // namespace

const GenicamFormat* find_genicam_format(std::uint32_t code) {
  return find(code, &GenicamFormat::code);
}

const GenicamFormat* find_genicam_format(std::string_view name) {
  return find(name, &GenicamFormat::name);
}

PixelFormat frame_format(const GenicamFormat& format, bool colour) {
  return colour && format.mosaic != Mosaic::None ? PixelFormat::Bgr : format.format;
}

bool is_zero_copy(const GenicamFormat& format, bool colour) {
  return format.packing == SamplePacking::None && frame_format(format, colour) == format.format;
}

bool is_whole(const GenicamFormat& format, int width, int height) {
  const bool is_mosaic = format.mosaic != Mosaic::None;
  const bool shares_chroma = info(format.format).colour == ColourModel::Yuv;
  const int columns = std::max(static_cast<int>(group_of(format.packing).samples),
                               is_mosaic || shares_chroma ? 2 : 1);
  return width > 0 && height > 0 && width % columns == 0 && height % (is_mosaic ? 2 : 1) == 0;
}

std::size_t sent_row_bytes(const GenicamFormat& format, int width) {
  if (format.packing == SamplePacking::None) {
    return static_cast<std::size_t>(row_bytes(format.format, width));
  }
  const Group group = group_of(format.packing);
  return static_cast<std::size_t>(width) / group.samples * group.bytes;
}

}  // namespace orbwatch::hal
