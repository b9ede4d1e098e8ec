#pragma once

#include <algorithm>
#include <cstdint>

#include "proc/image/image_view.h"
#include "proc/image/pixel_format.h"

namespace orbwatch::remap {

/// Y'CbCr to R'G'B' in Q14 integers, rounded and clipped. Coefficients from Kr, Kb of ITU-R BT.601
/// and BT.709.
class YuvToRgb {
 public:
  explicit constexpr YuvToRgb(ColourSpace space) {
    const double kr = space.matrix == ColourMatrix::Bt601 ? 0.299 : 0.2126;
    const double kb = space.matrix == ColourMatrix::Bt601 ? 0.114 : 0.0722;
    const double kg = 1 - kr - kb;
    const bool full = space.range == ColourRange::Full;
    const double y_gain = full ? 1 : 255.0 / 219, c_gain = full ? 1 : 255.0 / 224;
    black_ = full ? 0 : 16;
    y_ = fixed(y_gain);
    red_v_ = fixed(2 * (1 - kr) * c_gain);
    green_u_ = fixed(-2 * (1 - kb) * kb / kg * c_gain);
    green_v_ = fixed(-2 * (1 - kr) * kr / kg * c_gain);
    blue_u_ = fixed(2 * (1 - kb) * c_gain);
  }

  constexpr void operator()(int y, int u, int v, std::uint8_t* rgb) const {
    const int luminance = (y - black_) * y_ + (1 << (kBits - 1)), cb = u - 128, cr = v - 128;
    rgb[0] = clip((luminance + red_v_ * cr) >> kBits);
    rgb[1] = clip((luminance + green_u_ * cb + green_v_ * cr) >> kBits);
    rgb[2] = clip((luminance + blue_u_ * cb) >> kBits);
  }

 private:
  static constexpr int kBits = 14;
  static constexpr int fixed(double value) {
    return static_cast<int>(value * (1 << kBits) + (value < 0 ? -0.5 : 0.5));
  }
  static constexpr std::uint8_t clip(int value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0, 255));
  }

  int black_;
  int y_;
  int red_v_;
  int green_u_;
  int green_v_;
  int blue_u_;
};

/// Luma of an R'G'B' pixel by BT.601, 0..255.
constexpr std::uint8_t luma(const std::uint8_t* rgb) {
  return static_cast<std::uint8_t>((rgb[0] * 19595 + rgb[1] * 38470 + rgb[2] * 7471 + 32768) >> 16);
}

}  // namespace orbwatch::remap
