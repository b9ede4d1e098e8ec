// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "proc/image/picture.h"

namespace orbwatch::hal {

/// R G B, or three times the luminance, of one pixel in 0..255: directly from the definitions of
/// the formats, without code of the product.
inline std::array<double, 3> colours_at(const Picture& picture, int x, int y) {
  const auto sample = [&](std::size_t plane, int column, int row) {
    const auto& p = picture.planes[plane];
    return static_cast<double>(std::to_integer<int>(p.data[row * p.stride + column]));
  };
  const auto deep = [&](int bits) {
    const double value = sample(0, 2 * x, y) + 256 * sample(0, 2 * x + 1, y);
    return value / (1 << (bits - 8));
  };
  const auto rgb = [&](double luma, double u, double v) -> std::array<double, 3> {
    const bool full = picture.colour_space.range == ColourRange::Full;
    const bool bt709 = picture.colour_space.matrix == ColourMatrix::Bt709;
    const double kr = bt709 ? 0.2126 : 0.299;
    const double kb = bt709 ? 0.0722 : 0.114;
    const double l = full ? luma : (luma - 16) * 255 / 219;
    const double pb = (u - 128) * (full ? 1 : 255.0 / 224);
    const double pr = (v - 128) * (full ? 1 : 255.0 / 224);
    const double r = l + 2 * (1 - kr) * pr;
    const double b = l + 2 * (1 - kb) * pb;
    return {r, (l - kr * r - kb * b) / (1 - kr - kb), b};
  };
  const auto grey = [](double value) { return std::array{value, value, value}; };
  const int even = x / 2 * 2;
  switch (picture.format) {
    case PixelFormat::Grey:
      return grey(sample(0, x, y));
    case PixelFormat::Y10:
      return grey(deep(10));
    case PixelFormat::Y12:
      return grey(deep(12));
    case PixelFormat::Y16:
      return grey(deep(16));
    case PixelFormat::Yuyv:
      return rgb(sample(0, 2 * x, y), sample(0, 2 * even + 1, y), sample(0, 2 * even + 3, y));
    case PixelFormat::Uyvy:
      return rgb(sample(0, 2 * x + 1, y), sample(0, 2 * even, y), sample(0, 2 * even + 2, y));
    case PixelFormat::Nv12:
      return rgb(sample(0, x, y), sample(1, even, y / 2), sample(1, even + 1, y / 2));
    case PixelFormat::Nv21:
      return rgb(sample(0, x, y), sample(1, even + 1, y / 2), sample(1, even, y / 2));
    case PixelFormat::I420:
      return rgb(sample(0, x, y), sample(1, x / 2, y / 2), sample(2, x / 2, y / 2));
    case PixelFormat::Rgb:
      return {sample(0, 3 * x, y), sample(0, 3 * x + 1, y), sample(0, 3 * x + 2, y)};
    case PixelFormat::Bgr:
      return {sample(0, 3 * x + 2, y), sample(0, 3 * x + 1, y), sample(0, 3 * x, y)};
    case PixelFormat::Bgra:
      return {sample(0, 4 * x + 2, y), sample(0, 4 * x + 1, y), sample(0, 4 * x, y)};
    case PixelFormat::Rgb16:
      break;
  }
  return {-1, -1, -1};
}

}  // namespace orbwatch::hal
