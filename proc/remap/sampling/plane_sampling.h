// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "proc/image/pixel_format.h"
#include "proc/remap/kernel/kernel.h"

namespace orbwatch::remap {

/// The siting of a subsampled plane along one axis.
enum class Siting : std::uint8_t {
  Full,     ///< one sample for each pixel of the picture
  Cosited,  ///< one for two, at the place of the first: horizontally in 4:2:2, as in UVC and MPEG-2
  Centred,  ///< one for two, between them: 4:2:0 of JPEG and cameras' image processors
};
constexpr int shift(Siting siting) { return siting == Siting::Full ? 0 : 1; }

/// Samples of one plane of a format that are sampled together. The view's plane has the source's
/// siting, so chroma of a 4:2:0 view has a quarter of the luminance's pixels.
struct PlaneSampling {
  Layout layout;
  std::size_t plane = 0;
  int offset = 0;  ///< bytes from the plane's start
  Siting x = Siting::Full;
  Siting y = Siting::Full;
  std::uint8_t black = 0;  ///< value of undefined pixels in full range
};

/// The samplings of a format, luminance first.
struct SamplingList {
  std::array<PlaneSampling, 3> items;
  std::size_t count = 0;

  constexpr const PlaneSampling* begin() const { return items.data(); }
  constexpr const PlaneSampling* end() const { return items.data() + count; }
};

constexpr SamplingList samplings(PixelFormat format) {
  using enum Siting;
  constexpr std::uint8_t kNeutral = 128;
  switch (format) {
    case PixelFormat::Grey:
      return {{{{Layout::One8}}}, 1};
    case PixelFormat::Y10:
    case PixelFormat::Y12:
    case PixelFormat::Y16:
      return {{{{Layout::One16}}}, 1};
    case PixelFormat::Yuyv:
      return {{{{Layout::FirstOfTwo8}, {Layout::OddOfFour8, 0, 0, Cosited, Full, kNeutral}}}, 2};
    case PixelFormat::Uyvy:
      return {{{{Layout::FirstOfTwo8, 0, 1}, {Layout::OddOfFour8, 0, -1, Cosited, Full, kNeutral}}},
              2};
    case PixelFormat::Nv12:
    case PixelFormat::Nv21:
      return {{{{Layout::One8}, {Layout::Two8, 1, 0, Centred, Centred, kNeutral}}}, 2};
    case PixelFormat::I420:
      return {{{{Layout::One8},
                {Layout::One8, 1, 0, Centred, Centred, kNeutral},
                {Layout::One8, 2, 0, Centred, Centred, kNeutral}}},
              3};
    case PixelFormat::Rgb:
    case PixelFormat::Bgr:
      return {{{{Layout::Three8}}}, 1};
    case PixelFormat::Bgra:
      return {{{{Layout::Four8}}}, 1};
    case PixelFormat::Rgb16:
      break;
  }
  return {{{{Layout::Three16}}}, 1};
}

}  // namespace orbwatch::remap
