#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "proc/image/image_view.h"
#include "proc/remap/remap.h"

namespace orbwatch::remap {

/// Most sources that one view merges.
inline constexpr std::size_t kMaxSources = 4;

/// The share of each source in a pixel, for every set of sources that can see it. A set is a bit
/// mask, bit n for source n; shares are Q8 and add up to 256. Where only one camera sees, its share
/// is whole, whatever its weight: a camera fills the other's blind cone.
class MergeWeights {
 public:
  /// `weights`: one per source, >= 0, finite. A source of weight 0 does not count as seeing.
  explicit MergeWeights(std::span<const double> weights);

  const std::array<std::uint16_t, kMaxSources>& shares(std::size_t mask) const {
    return shares_[mask];
  }

 private:
  std::array<std::array<std::uint16_t, kMaxSources>, std::size_t{1} << kMaxSources> shares_{};
};

/// Blends the tile rows `rows` of up to kMaxSources RGB pictures of the same size into `rgb`.
/// `coverage` holds per pixel the mask of the sources that see it. Pixels that none sees become 0.
/// `validity` becomes Seen where some source of weight sees; elsewhere it is left as it was.
/// Reentrant.
void merge(std::span<const ImageView<const std::uint8_t>> sources,
           const ImageView<const std::uint8_t>& coverage, const MergeWeights& weights,
           const ImageView<std::uint8_t>& rgb, const ImageView<std::uint8_t>& validity,
           TileRows rows);

}  // namespace orbwatch::remap
