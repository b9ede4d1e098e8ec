// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "proc/image/picture.h"
#include "proc/remap/colour/run.h"
#include "proc/remap/grid/coordinate.h"

namespace orbwatch::remap {

/// Colour space of JPEG (JFIF) and of I420 views.
inline constexpr ColourSpace kJfif{ColourMatrix::Bt601, ColourRange::Full};

/// Rows of kTile samples of luma, and half as many rows of half as many of each chroma.
struct Yuv420Planes {
  struct Plane {
    std::uint8_t* first;
    std::ptrdiff_t stride;

    std::uint8_t* row(int number) const { return first + number * stride; }
  };
  Plane y, u, v;
};

/// The planes of an I420 picture from its pixel (x, y) on, both even.
inline Yuv420Planes planes_at(const MutablePicture& picture, int x, int y) {
  const auto plane = [&](std::size_t n, int column, int row) -> Yuv420Planes::Plane {
    const auto& [data, stride] = picture.planes[n];
    return {reinterpret_cast<std::uint8_t*>(data) + row * stride + column, stride};
  };
  return {plane(0, x, y), plane(1, x / 2, y / 2), plane(2, x / 2, y / 2)};
}

/// A tile of I420 in memory of its own, in rows of kRun samples: those of luma, then those of
/// chroma, U before V in each.
struct Yuv420Tile {
  static constexpr int kChromaRows = kTile / 2;
  static constexpr std::ptrdiff_t kFirstOfChroma = kTile * kRun;

  Yuv420Planes planes() {
    std::uint8_t* const chroma = samples.data() + kFirstOfChroma;
    return {{samples.data(), kRun}, {chroma, kRun}, {chroma + kRun / 2, kRun}};
  }
  /// The same as a picture in kJfif.
  MutablePicture picture() {
    MutablePicture picture{PixelFormat::I420, kJfif, kTile, kTile, {}};
    const auto [y, u, v] = planes();
    picture.planes = {{{reinterpret_cast<std::byte*>(y.first), y.stride},
                       {reinterpret_cast<std::byte*>(u.first), u.stride},
                       {reinterpret_cast<std::byte*>(v.first), v.stride}}};
    return picture;
  }

  alignas(64) std::array<std::uint8_t, (kTile + kChromaRows) * kRun> samples;
};

}  // namespace orbwatch::remap
