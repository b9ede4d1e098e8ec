// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace orbwatch::remap {

/// Samples of a plane that a kernel reads; it writes those samples without gaps.
enum class Layout : std::uint8_t {
  One8,         ///< grey, Y, U or V
  Two8,         ///< U V pairs
  Three8,       ///< R G B
  Four8,        ///< B G R A
  FirstOfTwo8,  ///< Y of Y U Y V
  OddOfFour8,   ///< U and V of Y U Y V, a pixel of which is four samples
  One16,        ///< 16 bit
  Three16,      ///< R G B of 16 bit, of stored pictures; sampled point by point only
};
inline constexpr std::size_t kLayouts = 8;
inline constexpr std::size_t kKernelLayouts = 7;

/// The description of a Layout.
struct LayoutInfo {
  int pixel_bytes;   ///< distance between pixels in the source
  int first;         ///< the first sample that is read
  int every;         ///< distance from there to each further sample
  int samples;       ///< number read per pixel
  int sample_bytes;  ///< 1 or 2
  constexpr int out_bytes() const { return samples * sample_bytes; }
};
inline constexpr std::array<LayoutInfo, kLayouts> kLayoutInfo{{
    {1, 0, 1, 1, 1},
    {2, 0, 1, 2, 1},
    {3, 0, 1, 3, 1},
    {4, 0, 1, 4, 1},
    {2, 0, 1, 1, 1},
    {4, 1, 2, 2, 1},
    {2, 0, 1, 1, 2},
    {6, 0, 1, 3, 2},
}};
constexpr const LayoutInfo& info(Layout layout) {
  return kLayoutInfo[static_cast<std::size_t>(layout)];
}

/// The layout of the output for `layout`: the samples that are read, without gaps.
constexpr Layout packed(Layout layout) {
  if (layout == Layout::FirstOfTwo8) return Layout::One8;
  return layout == Layout::OddOfFour8 ? Layout::Two8 : layout;
}

/// A plane of a source, for one sampling.
struct SourcePlane {
  const std::uint8_t* data = nullptr;  ///< includes the sampling's offset
  std::ptrdiff_t stride = 0;           ///< bytes
  int width = 0;                       ///< pixels of the plane
  int height = 0;
};

/// The part of a view's plane that is being filled.
struct TargetPlane {
  std::uint8_t* data = nullptr;
  std::ptrdiff_t stride = 0;  ///< bytes
  int columns = 0;            ///< pixels of the plane, at most kTile
  int rows = 0;
};

}  // namespace orbwatch::remap
