// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "proc/image/picture.h"
#include "proc/remap/colour/colour_conversion.h"
#include "proc/remap/colour/colour_map.h"
#include "proc/remap/colour/luma.h"
#include "proc/remap/colour/yuv420.h"
#include "proc/remap/grid/coordinate_grid.h"
#include "proc/remap/kernel/kernel.h"
#include "proc/remap/merge/blend_grid.h"
#include "proc/remap/merge/merge.h"
#include "proc/remap/merge/merged_remap.h"
#include "proc/remap/merge/photometric_match.h"
#include "proc/remap/sampling/pyramid.h"
#include "proc/remap/sampling/sharpened_picture.h"
#include "proc/remap/sampling/tile_remap.h"

// The public header of this folder: users include nothing below it.

namespace orbwatch::remap {

/// True if a source of format `from` can be remapped to a view of format `to`: the same, or from
/// YUV and RGB of 8 bit to Rgb or Bgr.
constexpr bool can_remap(PixelFormat from, PixelFormat to) {
  const bool eight_bit_colour =
      info(from).colour != ColourModel::Luminance && info(from).bytes_per_sample() == 1;
  return from == to || (eight_bit_colour && (to == PixelFormat::Rgb || to == PixelFormat::Bgr));
}

/// Fills the tile rows `rows` of `out` from a source. Every format is sampled in its memory layout;
/// if `out` has another format, it is converted tile by tile. Undefined pixels become black.
///
/// `source`: the picture and any number of its mip levels (see Pyramid). Each tile samples the
/// level that the grid requires, or the last one; so without levels a view smaller than its source
/// aliases. Preconditions, asserted: the picture has the size that the grid was built for, `out`
/// the view's; a subsampled `out` has even sides; can_remap() their formats. Reentrant; different
/// rows may be filled at the same time, with the same result.
void remap(const CoordinateGrid& grid, std::span<const Picture> source, Interpolation interpolation,
           const MutablePicture& out, TileRows rows, const Kernel& kernel = default_kernel());

}  // namespace orbwatch::remap
