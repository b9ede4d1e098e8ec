#pragma once

#include <cstdint>

#include "proc/image/image_view.h"
#include "proc/image/picture.h"
#include "proc/remap/coordinate_grid.h"

namespace orbwatch::remap {

enum class Interpolation { Bilinear, Nearest };

/// Rows of tiles [first, last) of a view: the unit of work that threads share.
struct TileRows {
  int first = 0;
  int last = 0;
};

/// Samples per pixel that remapping a source of `format` yields: 1 for one-channel formats, 3 (RGB)
/// for colour, YUYV included.
constexpr int remapped_channels(PixelFormat format) { return info(format).channels == 1 ? 1 : 3; }

/// Fills the tile rows `rows` of `out` with what the view sees in `source`, in the source's own
/// format; YUYV is converted to RGB while it is at hand. Undefined pixels become 0.
///
/// `source` has the size that the grid was built for; `out` has the view's size,
/// remapped_channels() and the source's sample size: uint8_t, or uint16_t for the 16-bit formats.
/// Both are the caller's to guarantee (checked by assertions). Reentrant; different rows may be
/// filled at the same time.
void remap(const CoordinateGrid& grid, const Picture& source, Interpolation interpolation,
           const ImageView<std::uint8_t>& out, TileRows rows);
void remap(const CoordinateGrid& grid, const Picture& source, Interpolation interpolation,
           const ImageView<std::uint16_t>& out, TileRows rows);

}  // namespace orbwatch::remap
