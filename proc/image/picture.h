#pragma once

#include <cstddef>
#include <cstdint>

#include "proc/image/image_view.h"
#include "proc/image/pixel_format.h"

namespace orbwatch {

/// Largest side of a picture or view, pixels: no camera makes larger ones, and a forged size must
/// not eat the memory. Fixed-point coordinates rely on it.
inline constexpr int kMaxSide = 16384;

/// A picture in a camera's own format that somebody else owns. All formats so far have one plane;
/// `stride` is the distance between rows in bytes. Reentrant.
struct Picture {
  PixelFormat format = PixelFormat::Grey;
  ColourSpace colour_space;
  int width = 0;
  int height = 0;
  const std::byte* data = nullptr;
  std::ptrdiff_t stride = 0;

  /// The samples as T. T must fit the format: uint8_t for 8 bit, uint16_t for 16 bit, with data and
  /// stride aligned to it.
  template <class T>
  ImageView<const T> samples() const {
    return {reinterpret_cast<const T*>(data), width, height, info(format).channels,
            stride / static_cast<std::ptrdiff_t>(sizeof(T))};
  }
};

}  // namespace orbwatch
