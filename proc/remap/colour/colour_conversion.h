#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "proc/image/pixel_format.h"

namespace orbwatch::remap {

/// So many pixels side by side are converted together: their loops become vector code.
inline constexpr std::size_t kRun = 16;

/// One 8 bit sample of each pixel of a run.
using SampleRun = std::array<std::uint8_t, kRun>;

/// The colours of a run.
struct RgbRun {
  SampleRun red, green, blue;
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
    black_ = (1 << (kBits - 1)) - (full ? 0 : 16) * y_;
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

  /// The same for a run of pixels, two side by side of which share a pair (U, V) of `chroma`.
  [[gnu::always_inline]] RgbRun operator()(const SampleRun& luminance,
                                           const SampleRun& chroma) const {
    const EvenOdd y(luminance), uv(chroma);
    const Lanes even = times(y.even, y_), odd = times(y.odd, y_);
    const Lanes red_v = times(uv.odd, red_v_), blue_u = times(uv.even, blue_u_);
    const Lanes green_u = times(uv.even, green_u_), green_v = times(uv.odd, green_v_);
    Lanes red, green, blue;
    for (std::size_t i = 0; i < kPairs; ++i) red[i] = red_v[i] + red_;
    for (std::size_t i = 0; i < kPairs; ++i) green[i] = green_ - green_u[i] - green_v[i];
    for (std::size_t i = 0; i < kPairs; ++i) blue[i] = blue_u[i] + blue_;
    return {samples(even, odd, red), samples(even, odd, green), samples(even, odd, blue)};
  }

  /// Luma alone, 0..255: what a pixel without colour gets in all three.
  constexpr std::uint8_t luma(int y) const { return clip((y * y_ + black_) >> kBits); }

 private:
  static constexpr int kBits = 14;
  static constexpr std::size_t kPairs = kRun / 2;
  using Lanes = std::array<std::int32_t, kPairs>;
  using Words = std::array<std::uint16_t, kPairs>;

  /// The even and the odd samples of a run.
  struct EvenOdd {
    [[gnu::always_inline]] explicit EvenOdd(const SampleRun& run) {
      static_assert(std::endian::native == std::endian::little);
      const auto words = std::bit_cast<Words>(run);
      for (std::size_t i = 0; i < kPairs; ++i) even[i] = words[i] & 0xff;
      for (std::size_t i = 0; i < kPairs; ++i) odd[i] = words[i] >> 8;
    }
    Words even, odd;
  };

  static constexpr std::uint16_t fixed(double value) {
    const auto twice = static_cast<int>(value * (2 << kBits));
    return static_cast<std::uint16_t>((twice + 1) / 2);
  }
  static constexpr std::uint8_t clip(int value) {
    return static_cast<std::uint8_t>(std::clamp(value, 0, 255));
  }

  [[gnu::always_inline]] static Lanes times(const Words& samples, std::uint16_t coefficient) {
    Lanes products;
    for (std::size_t i = 0; i < kPairs; ++i) {
      products[i] = static_cast<std::int32_t>(std::uint32_t{samples[i]} * coefficient);
    }
    return products;
  }

  /// A colour from the luminance of every second pixel each, and what each pair shares.
  [[gnu::always_inline]] static SampleRun samples(const Lanes& even, const Lanes& odd,
                                                  const Lanes& shared) {
    const Words low = clipped(even, shared), high = clipped(odd, shared);
    Words words;
    for (std::size_t i = 0; i < kPairs; ++i) {
      words[i] = static_cast<std::uint16_t>(low[i] | high[i] << 8);
    }
    return std::bit_cast<SampleRun>(words);
  }
  [[gnu::always_inline]] static Words clipped(const Lanes& luminance, const Lanes& shared) {
    std::array<std::int16_t, kPairs> values;
    for (std::size_t i = 0; i < kPairs; ++i) {
      values[i] = static_cast<std::int16_t>((luminance[i] + shared[i]) >> kBits);
    }
    Words words;
    for (std::size_t i = 0; i < kPairs; ++i) {
      words[i] = static_cast<std::uint16_t>(std::clamp<std::int16_t>(values[i], 0, 255));
    }
    return words;
  }

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

/// Luma of a pixel that the camera gave as R'G'B', by BT.601, 0..255.
constexpr std::uint8_t luma(const std::uint8_t* rgb) {
  return static_cast<std::uint8_t>((rgb[0] * 19595 + rgb[1] * 38470 + rgb[2] * 7471 + 32768) >> 16);
}

}  // namespace orbwatch::remap
