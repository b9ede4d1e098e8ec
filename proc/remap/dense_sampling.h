#pragma once

#include <algorithm>
#include <cstdint>

#include "proc/remap/coordinate.h"
#include "proc/remap/interpolation.h"

namespace orbwatch::remap {

/// A plane of a source, as a sampling reads it.
struct SourcePlane {
  const std::uint8_t* data = nullptr;  ///< with the sampling's offset
  std::ptrdiff_t stride = 0;           ///< bytes
  int width = 0;                       ///< in pixels of the plane
  int height = 0;
};

/// Part of a view's plane that is being filled.
struct TargetPlane {
  std::uint8_t* data = nullptr;
  std::ptrdiff_t stride = 0;  ///< bytes
  int columns = 0;            ///< in pixels of the plane, at most kTile
  int rows = 0;
};

/// Samples a tile pixel by pixel, each at its own coordinate; beyond the source's border its
/// outermost pixel goes on. Undefined pixels become `black`. Reentrant.
template <Layout layout>
void sample_dense(const CoordinateTile& coordinates, const SourcePlane& source, std::uint8_t black,
                  const TargetPlane& out) {
  constexpr LayoutInfo kInfo = info(layout);
  const auto pixel = [&](int u, int v) {
    return source.data + std::clamp(v, 0, source.height - 1) * source.stride +
           static_cast<std::ptrdiff_t>(std::clamp(u, 0, source.width - 1)) * kInfo.pixel_bytes;
  };
  for (int y = 0; y < out.rows; ++y) {
    std::uint8_t* to = out.data + y * out.stride;
    for (int x = 0; x < out.columns; ++x, to += kInfo.out_bytes()) {
      Coordinate c = coordinates[y][x];
      if (!is_defined(c)) {
        std::fill_n(to, kInfo.out_bytes(), black);
        continue;
      }
      c = {c.u + added_u(layout), c.v + added_v(layout)};
      const int u = c.u >> kFractionBits, v = c.v >> kFractionBits;
      interpolate_pixel<layout>(
          {pixel(u, v), pixel(u + 1, v), pixel(u, v + 1), pixel(u + 1, v + 1)}, c, to);
    }
  }
}

}  // namespace orbwatch::remap
