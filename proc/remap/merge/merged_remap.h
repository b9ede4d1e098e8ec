#pragma once

#include <cstdint>
#include <span>

#include "proc/image/image_view.h"
#include "proc/image/picture.h"
#include "proc/remap/colour/colour_map.h"
#include "proc/remap/grid/coordinate_grid.h"
#include "proc/remap/kernel/kernel.h"
#include "proc/remap/merge/blend_grid.h"
#include "proc/remap/merge/photometric_match.h"
#include "proc/remap/sampling/tile_remap.h"

namespace orbwatch::remap {

/// One source of a merged view at one moment.
struct MergedSource {
  const CoordinateGrid* grid = nullptr;
  /// The picture and its mip levels, as for remap(); empty: the source did not deliver.
  std::span<const Picture> pictures;
  /// Of a one-channel source of an Rgb, Bgr or Grey view; null in a Grey or Y16 view: its own
  /// counts.
  const ColourMap* colours = nullptr;
  /// The target of what is measured, whether or not it counts in the picture: Grey for the
  /// luminance of a colour or 8 bit source, a 16 bit source's own format for its counts. Luminance
  /// is of full range: of YUV the source's own Y, which colours outside RGB do not change, of RGB
  /// luma by BT.601. No data: none.
  MutablePicture measured;
  /// Brings the source to another one's exposure, unless it is colour-mapped; null: as it is.
  const PhotometricTable* match = nullptr;
  /// What is measured of a colour source in place of `pictures`, where these were sharpened to be
  /// shown; empty: the same.
  std::span<const Picture> measured_pictures = {};
};

/// How a view is merged from its sources.
struct MergePlan {
  const BlendGrid* blend = nullptr;  ///< of the sources, in their order
  MergeRule rule = MergeRule::Mean;
  Interpolation interpolation = Interpolation::Area;
  /// One Validity per pixel for when no source delivers.
  ImageView<const std::uint8_t> unseen;
};

/// Fills the tile rows `rows` of a view and of its validity from up to kMaxSources sources, all
/// grids of the view's size, in one pass: a tile with one source is written as by remap(), the
/// others are blended while they are in the cache. Pixels that none sees are black, their validity
/// is that of `unseen`.
///
/// The view is Rgb, Bgr, Grey or, of even size, I420 in kJfif, for sources of any format but Rgb16,
/// or has the one format of all sources: Y16 or Rgb16. I420 is converted tile by tile, or, of 4:2:0
/// in BT.601 that a tile shows alone, sampled as it is. Grey is the luminance of the sources: of
/// YUV sampled alone, in full range; else luma by BT.601 of colours. Without data nothing is shown:
/// only what is measured and the validity are written. Reentrant; different rows may be filled at
/// the same time, with the same result.
void merged_remap(std::span<const MergedSource> sources, const MergePlan& plan,
                  const MutablePicture& out, const ImageView<std::uint8_t>& validity, TileRows rows,
                  const Kernel& kernel = default_kernel());

}  // namespace orbwatch::remap
