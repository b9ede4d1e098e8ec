// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "proc/image/image_view.h"
#include "proc/image/pixel_format.h"

namespace orbwatch {

/// Largest side of a picture or view, pixels: bounds the memory for forged sizes; larger than any
/// camera's. Fixed-point coordinates rely on it.
inline constexpr int kMaxSide = 16384;

/// A non-owning picture in a format of kPixelFormats. Copying copies the reference, never the
/// samples. Reentrant.
template <class Byte>
struct BasicPicture {
  struct Plane {
    Byte* data = nullptr;
    std::ptrdiff_t stride = 0;  ///< from row to row, bytes
  };

  PixelFormat format = PixelFormat::Grey;
  ColourSpace colour_space;
  int width = 0;
  int height = 0;
  std::array<Plane, kMaxPlanes> planes;

  /// The picture whose planes follow one another from `data` on (see picture_bytes).
  static BasicPicture contiguous(PixelFormat format, int width, int height, Byte* data,
                                 std::ptrdiff_t stride) {
    BasicPicture picture{format, {}, width, height, {}};
    const PixelFormatInfo& facts = info(format);
    for (std::size_t n = 0; n < facts.plane_count(); ++n) {
      const PlaneInfo& plane = facts.planes[n];
      picture.planes[n] = {data, (stride * plane.samples >> plane.shift_x) / facts.channels()};
      data += picture.planes[n].stride * (height >> plane.shift_y);
    }
    return picture;
  }

  /// The first plane's samples as T. T must fit the format: uint8_t for 8 bit, uint16_t for more,
  /// with data and stride aligned to it.
  template <class T>
  auto samples() const {
    using Sample = std::conditional_t<std::is_const_v<Byte>, const T, T>;
    return ImageView<Sample>{reinterpret_cast<Sample*>(planes[0].data), width, height,
                             info(format).channels(),
                             planes[0].stride / static_cast<std::ptrdiff_t>(sizeof(T))};
  }

  operator BasicPicture<const Byte>() const  // NOLINT(google-explicit-constructor): adds const
      requires(!std::is_const_v<Byte>) {
    BasicPicture<const Byte> picture{format, colour_space, width, height, {}};
    for (std::size_t n = 0; n < kMaxPlanes; ++n) {
      picture.planes[n] = {planes[n].data, planes[n].stride};
    }
    return picture;
  }
};

using Picture = BasicPicture<const std::byte>;
using MutablePicture = BasicPicture<std::byte>;

/// Wraps samples as a picture of a one-plane format that they fit.
template <class T>
MutablePicture picture_of(PixelFormat format, const ImageView<T>& samples) {
  return MutablePicture::contiguous(format, samples.width, samples.height,
                                    reinterpret_cast<std::byte*>(samples.data),
                                    samples.stride * static_cast<std::ptrdiff_t>(sizeof(T)));
}

}  // namespace orbwatch
