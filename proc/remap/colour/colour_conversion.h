// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "proc/image/pixel_format.h"
#include "proc/remap/colour/lanes.h"
#include "proc/remap/colour/yuv_rows.h"

namespace orbwatch::remap {

/// The colours of a run.
struct RgbRun {
  SampleRun red, green, blue;
};

/// The chroma's contribution to a pair of pixels, in the colours of a run.
struct SharedColour {
  Lanes red, green, blue;
};

/// Y'CbCr to R'G'B' in Q14 integers, rounded and clipped. Coefficients from Kr, Kb of ITU-R BT.601
/// and BT.709. All of them are positive and fit 16 bits; rounding and the offsets of luminance and
/// chroma are one constant per colour.
class YuvToRgb {
 public:
  explicit constexpr YuvToRgb(ColourSpace space) {
    const double kr = space.matrix == ColourMatrix::Bt601 ? 0.299 : 0.2126;
    const double kb = space.matrix == ColourMatrix::Bt601 ? 0.114 : 0.0722;
    const double kg = 1 - kr - kb;
    const bool full = space.range == ColourRange::Full;
    const double y_gain = full ? 1 : 255.0 / 219, c_gain = full ? 1 : 255.0 / 224;
    y_ = fixed(y_gain);
    red_v_ = fixed(2 * (1 - kr) * c_gain);
    green_u_ = fixed(2 * (1 - kb) * kb / kg * c_gain);
    green_v_ = fixed(2 * (1 - kr) * kr / kg * c_gain);
    blue_u_ = fixed(2 * (1 - kb) * c_gain);
    constexpr int kNeutral = 128;
    floor_ = full ? 0 : 16;
    black_ = (1 << (kBits - 1)) - floor_ * y_;
    red_ = black_ - kNeutral * red_v_;
    green_ = black_ + kNeutral * (green_u_ + green_v_);
    blue_ = black_ - kNeutral * blue_u_;
  }

  constexpr void operator()(int y, int u, int v, std::uint8_t* rgb) const {
    const int luminance = y * y_;
    rgb[0] = clip((luminance + red_v_ * v + red_) >> kBits);
    rgb[1] = clip((luminance - green_u_ * u - green_v_ * v + green_) >> kBits);
    rgb[2] = clip((luminance + blue_u_ * u + blue_) >> kBits);
  }

  /// The same for runs of pixels, two adjacent of which share a pair (U, V) of `chroma`. The
  /// chroma's contribution to each colour is computed first: two rows may share it.
  [[gnu::always_inline]] SharedColour shared(const SampleRun& chroma) const {
    const EvenOdd uv(chroma);
    return {Lanes(red_).plus(uv.odd, red_v_),
            Lanes(green_).minus(uv.even, green_u_).minus(uv.odd, green_v_),
            Lanes(blue_).plus(uv.even, blue_u_)};
  }
  [[gnu::always_inline]] RgbRun operator()(const SampleRun& luminance,
                                           const SharedColour& shared) const {
    const EvenOdd y(luminance);
    const Lanes even = Lanes(0).plus(y.even, y_), odd = Lanes(0).plus(y.odd, y_);
    return {clipped_sums(even, odd, shared.red), clipped_sums(even, odd, shared.green),
            clipped_sums(even, odd, shared.blue)};
  }

  /// Luma alone, 0..255: the value of all three channels of a pixel without colour.
  constexpr std::uint8_t luma(int y) const { return clip((y * y_ + black_) >> kBits); }

  /// The same for a run.
  [[gnu::always_inline]] SampleRun luma(const SampleRun& luminance) const {
    return scaled(luminance, floor_, y_);
  }

  constexpr YuvCoefficients coefficients() const {
    return {y_, red_v_, green_u_, green_v_, blue_u_, red_, green_, blue_};
  }

 private:
  static constexpr int kBits = 14;

  static constexpr std::uint16_t fixed(double value) {
    const auto twice = static_cast<int>(value * (2 << kBits));
    return static_cast<std::uint16_t>((twice + 1) / 2);
  }
  static constexpr std::uint8_t clip(int value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0, 255));
  }

  std::uint8_t floor_;
  std::uint16_t y_;
  std::uint16_t red_v_;
  std::uint16_t green_u_;
  std::uint16_t green_v_;
  std::uint16_t blue_u_;
  std::int32_t black_;
  std::int32_t red_;
  std::int32_t green_;
  std::int32_t blue_;
};

}  // namespace orbwatch::remap
