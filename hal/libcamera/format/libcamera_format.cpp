// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/format/libcamera_format.h"

#include <algorithm>
#include <string>
#include <utility>

namespace orbwatch::hal {
namespace {

std::size_t plane_bytes(const Picture& picture, std::size_t n) {
  const int rows = picture.height >> info(picture.format).planes[n].shift_y;
  return static_cast<std::size_t>(picture.planes[n].stride) * static_cast<std::size_t>(rows);
}

tl::unexpected<Error> too_short(std::size_t n, std::size_t has, std::size_t needs) {
  return fail("plane " + std::to_string(n) + " of a buffer has " + std::to_string(has) +
              " bytes; it takes " + std::to_string(needs));
}

}  // namespace

const LibcameraFormat* find_format(libcamera::PixelFormat code) {
  const auto* const found = std::ranges::find(kLibcameraFormats, code, &LibcameraFormat::code);
  return found == kLibcameraFormats.end() ? nullptr : found;
}

std::optional<ColourSpace> colour_space_of(const std::optional<libcamera::ColorSpace>& space,
                                           PixelFormat format) {
  using libcamera::ColorSpace;
  if (info(format).colour != ColourModel::Yuv) {
    return ColourSpace{ColourMatrix::Bt601, ColourRange::Full};
  }
  if (!space) return ColourSpace{ColourMatrix::Bt601, ColourRange::Limited};
  const ColourRange range =
      space->range == ColorSpace::Range::Full ? ColourRange::Full : ColourRange::Limited;
  switch (space->ycbcrEncoding) {
    case ColorSpace::YcbcrEncoding::None:
    case ColorSpace::YcbcrEncoding::Rec601:
      return ColourSpace{ColourMatrix::Bt601, range};
    case ColorSpace::YcbcrEncoding::Rec709:
      return ColourSpace{ColourMatrix::Bt709, range};
    case ColorSpace::YcbcrEncoding::Rec2020:
      break;
  }
  return std::nullopt;
}

Result<Picture> lay_out(const LibcameraFormat& format, int width, int height, std::size_t stride,
                        std::span<const std::span<const std::byte>> planes) {
  if (planes.empty()) return too_short(0, 0, stride * static_cast<std::size_t>(height));
  Picture picture = Picture::contiguous(format.format, width, height, planes[0].data(),
                                        static_cast<std::ptrdiff_t>(stride));
  const std::size_t count = info(format.format).plane_count();
  if (planes.size() >= count) {
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t needs = plane_bytes(picture, n);
      if (planes[n].size() < needs) return too_short(n, planes[n].size(), needs);
      picture.planes[n].data = planes[n].data();
    }
  } else {
    const std::size_t needs = picture_bytes(format.format, stride, height);
    if (planes[0].size() < needs) return too_short(0, planes[0].size(), needs);
  }
  if (format.v_before_u) std::swap(picture.planes[1], picture.planes[2]);
  return picture;
}

}  // namespace orbwatch::hal
