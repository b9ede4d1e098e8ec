#pragma once

#include <cstdint>
#include <span>

#include "proc/image/image_view.h"
#include "proc/image/picture.h"
#include "proc/remap/blend_grid.h"
#include "proc/remap/colour_map.h"
#include "proc/remap/coordinate_grid.h"
#include "proc/remap/remap.h"

namespace orbwatch::remap {

/// How the sources of a view are joined where several see a pixel.
enum class MergeRule : std::uint8_t {
  Mean,   ///< by weight
  First,  ///< the first one that sees it has it alone
};

/// One source of a merged view at one moment.
struct MergedSource {
  const CoordinateGrid* grid = nullptr;
  /// The picture and its halves, as remap() takes them, of any format but Rgb16; none: the source
  /// did not deliver.
  std::span<const Picture> pictures;
  const ColourMap* colours = nullptr;  ///< of a one-channel source
  /// Where what is measured goes, whether or not it counts in the picture: Grey for the luminance
  /// of a colour or 8 bit source, a 16 bit source's own format for its counts. No data: nowhere.
  MutablePicture measured;
};

/// What a view needs to be merged from its sources, all of them of one size.
struct MergePlan {
  const BlendGrid* blend = nullptr;  ///< of the sources, in their order
  MergeRule rule = MergeRule::Mean;
  Interpolation interpolation = Interpolation::Area;
  /// One Validity per pixel for when no source delivers.
  ImageView<const std::uint8_t> unseen;
};

/// Fills the tile rows `rows` of an RGB view and of its validity from up to kMaxSources sources in
/// one pass: a tile that one source has alone is written as remap() would, the others are blended
/// tile by tile while they are in the cache. Pixels that none sees are black, and as valid as
/// `unseen` says.
///
/// Reentrant; different rows may be filled at the same time, with the same result.
void merged_remap(std::span<const MergedSource> sources, const MergePlan& plan,
                  const ImageView<std::uint8_t>& rgb, const ImageView<std::uint8_t>& validity,
                  TileRows rows, const Kernel& kernel = default_kernel());

}  // namespace orbwatch::remap
