#pragma once

#include <span>

#include "proc/image/picture.h"
#include "proc/remap/coordinate_grid.h"
#include "proc/remap/kernel.h"
#include "proc/remap/tile_remap.h"

namespace orbwatch::remap {

/// Rows of tiles [first, last) of a view: the unit of work that threads share.
struct TileRows {
  int first = 0;
  int last = 0;
};

/// A source of format `from` can be remapped to a view of format `to`: to its own, or from YUV and
/// RGB of 8 bit to Rgb or Bgr.
constexpr bool can_remap(PixelFormat from, PixelFormat to) {
  const bool eight_bit_colour =
      info(from).colour != ColourModel::Luminance && info(from).bytes_per_sample() == 1;
  return from == to || (eight_bit_colour && (to == PixelFormat::Rgb || to == PixelFormat::Bgr));
}

/// Fills the tile rows `rows` of `out` with what the view sees in a source. Every format is sampled
/// as it lies in memory; what the view wants in another one is converted tile by tile. Undefined
/// pixels become black.
///
/// `source` is the picture, followed by as many of its halves as there are (see Pyramid): each tile
/// samples the one that the grid asks for, or the last; so without halves a view that is smaller
/// than its source aliases. The picture has the size that the grid was built for, `out` the view's;
/// a subsampled `out` has even sides. can_remap() their formats. All of this is the caller's to
/// guarantee (checked by assertions). Reentrant; different rows may be filled at the same time,
/// with the same result.
void remap(const CoordinateGrid& grid, std::span<const Picture> source, Interpolation interpolation,
           const MutablePicture& out, TileRows rows, const Kernel& kernel = default_kernel());

}  // namespace orbwatch::remap
