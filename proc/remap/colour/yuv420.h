// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "proc/image/image_view.h"
#include "proc/image/picture.h"
#include "proc/remap/colour/tile_conversion.h"
#include "proc/remap/colour/yuv420_tile.h"

namespace orbwatch::remap {

/// Writes a tile's Rgb pixels into its area of `out`, I420 in kJfif: Y as luma(), the chroma of
/// each two by two pixels as that of their mean colour, rounded. The area's place and size are
/// even. Reentrant.
void write_yuv420(const ImageView<const std::uint8_t>& rgb, const MutablePicture& out,
                  const TileArea& area);

/// True if a source's samples equal those of an I420 view in kJfif except for their range.
constexpr bool is_yuv420(PixelFormat format, ColourSpace colour_space) {
  return (format == PixelFormat::Nv12 || format == PixelFormat::Nv21 ||
          format == PixelFormat::I420) &&
         colour_space.matrix == kJfif.matrix;
}

/// Writes a tile that was sampled from such a source into its area of `out`, I420 in kJfif,
/// converted to the full range. The area's place and size are even. Reentrant.
void write_yuv420(const SampledTile& tile, PixelFormat format, ColourSpace colour_space,
                  const MutablePicture& out, const TileArea& area);

/// Copies a tile's planes, as far as they lie in its area of `out`, I420. The area's place and size
/// are even. Reentrant.
void write_yuv420(const Yuv420Planes& tile, const MutablePicture& out, const TileArea& area);

}  // namespace orbwatch::remap
