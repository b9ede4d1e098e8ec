// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>

#include "proc/image/picture.h"
#include "proc/remap/colour/planar_tile.h"
#include "proc/remap/grid/coordinate.h"
#include "proc/remap/sampling/plane_sampling.h"

namespace orbwatch::remap {

/// A tile in its source's samplings, each in rows of kTile pixels of its plane.
struct SampledTile {
  static constexpr int kMostBytes = 6;  ///< bytes of a pixel: Three16
  alignas(64) std::array<std::array<std::uint8_t, kTile * kTile * kMostBytes>, 3> planes;

  static constexpr std::ptrdiff_t stride(const PlaneSampling& sampling) {
    return std::ptrdiff_t{kTile} * info(sampling.layout).out_bytes();
  }
};

/// Area of a tile in a view, cut at the view's border.
struct TileArea {
  int x, y, columns, rows;
};

/// The sample of an undefined pixel.
constexpr std::uint8_t black(const PlaneSampling& sampling, PixelFormat format,
                             ColourSpace colour_space) {
  const bool raised = info(format).colour == ColourModel::Yuv &&
                      colour_space.range == ColourRange::Limited && sampling.black == 0;
  return raised ? 16 : sampling.black;
}

/// Writes a tile that was sampled from `format` into its area of `out`, in the format of `out` (see
/// can_remap). Every kernel produces the same bytes. Reentrant.
void write_tile(const SampledTile& tile, PixelFormat format, ColourSpace colour_space,
                const MutablePicture& out, const TileArea& area, const Kernel& kernel);

/// Writes a whole tile that was sampled from a format of colours in planes, in the order `order`,
/// Rgb or Bgr. Reentrant.
void write_planes(const SampledTile& tile, PixelFormat format, ColourSpace colour_space,
                  PixelFormat order, PlanarTile& out);

/// Separates the channels of a whole tile of three. Reentrant.
void separate(const std::uint8_t* pixels, PlanarTile& out);

/// Writes the luminance of a tile that was sampled from a Yuv format into its area of `out`, Grey:
/// the source's own Y, brought to the full range. Reentrant.
void write_luminance(const SampledTile& tile, ColourSpace colour_space, const MutablePicture& out,
                     const TileArea& area);

/// Sets an area to black.
void clear_area(const MutablePicture& out, const TileArea& area);

/// Sets the undefined pixels of an area of an Rgb or Bgr picture to black.
void clear_undefined(const CoordinateTile& coordinates, const MutablePicture& out,
                     const TileArea& area);

}  // namespace orbwatch::remap
