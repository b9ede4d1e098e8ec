// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>

#include "proc/image/image_view.h"
#include "proc/remap/grid/coordinate.h"
#include "proc/remap/kernel/mixed_tile.h"

namespace orbwatch::remap {

/// A set of a view's sources: bit n is the n-th.
using SourceSet = std::uint8_t;

/// Rule for pixels that several sources see.
enum class MergeRule : std::uint8_t {
  Mean,   ///< weighted mean
  First,  ///< only the first source that sees it
};

/// One source of a merged picture: its picture of the view, and the weights of its pixels (see
/// BlendGrid). Weight 0: it does not see the pixel, whose samples are not used.
template <class T>
struct MergeSource {
  ImageView<const T> picture;
  ImageView<const std::uint8_t> weights;
};

/// Merges the tile rows `rows` of up to kMaxSources pictures into `out`: by MergeRule::Mean rounded
/// to nearest, exactly. A source that alone sees a pixel passes unchanged, whatever its weight: a
/// camera fills the other's blind cone. Pixels that none sees become 0. `validity` becomes Seen
/// where some source sees; elsewhere it is not changed.
///
/// Pictures, weights, `out` and `validity` have one size; pictures and `out` 1 or 3 channels. `out`
/// may be one of the pictures. T is uint8_t or uint16_t. Reentrant.
template <class T>
void merge(MergeRule rule, std::span<const MergeSource<T>> sources, const ImageView<T>& out,
           const ImageView<std::uint8_t>& validity, TileRows rows);

}  // namespace orbwatch::remap
