// SPDX-License-Identifier: Apache-2.0
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
  /// The picture and its mip levels, see remap(); empty: the source did not deliver.
  std::span<const Picture> pictures;
  /// Colours of a one-channel source in an Rgb, Bgr or Grey view; null in a Grey or Y16 view: its
  /// own counts.
  const ColourMap* colours = nullptr;
  /// The target of the measured plane, whether or not the source counts in the picture: Grey for
  /// the luminance of a colour or 8 bit source, a 16 bit source's own format for its counts.
  /// Luminance is of full range: for YUV the source's own Y, which colours outside RGB do not
  /// change, for RGB luma by BT.601. No data: none.
  MutablePicture measured;
  /// Matches the source's exposure to another one's, unless it is colour-mapped; null: unchanged.
  const PhotometricTable* match = nullptr;
  /// Pictures of a colour source that are measured in place of `pictures`, where these were
  /// sharpened for display; empty: the same.
  std::span<const Picture> measured_pictures = {};
  /// An earlier call with the same source wrote `measured`; it is only read.
  bool is_measured_before = false;
};

/// Parameters of merging a view's sources.
struct MergePlan {
  const BlendGrid* blend = nullptr;  ///< weights of the sources, in their order
  MergeRule rule = MergeRule::Mean;
  Interpolation interpolation = Interpolation::Area;
  /// One Validity per pixel, used when no source delivers.
  ImageView<const std::uint8_t> unseen;
};

/// Fills the tile rows `rows` of a view and of its validity from up to kMaxSources sources, all
/// grids of the view's size, in one pass: a tile with one source is written as by remap(), the
/// others are blended while they are in the cache. Pixels that none sees are black, their validity
/// is that of `unseen`.
///
/// The view is Rgb, Bgr, Grey or, of even size, I420 in kJfif, for sources of any format but Rgb16,
/// or has the one format of all sources: Y16 or Rgb16. A tile of I420 is written without conversion
/// where its sources cover it, alone or each with its share, and all are 4:2:0 in BT.601 of
/// unmatched exposure or mapped to colours; other tiles are converted from Rgb. Grey is the
/// luminance of the sources: for YUV sampled alone, in full range; else luma by BT.601 of colours.
/// Without data in `out` only measured planes and validity are written. Reentrant; different rows
/// may be filled at the same time, with the same result.
void merged_remap(std::span<const MergedSource> sources, const MergePlan& plan,
                  const MutablePicture& out, const ImageView<std::uint8_t>& validity, TileRows rows,
                  const Kernel& kernel = default_kernel());

}  // namespace orbwatch::remap
