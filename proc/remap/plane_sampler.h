#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "proc/image/picture.h"
#include "proc/remap/block_map.h"
#include "proc/remap/coordinate.h"
#include "proc/remap/dense_sampling.h"
#include "proc/remap/kernel.h"
#include "proc/remap/plane_map.h"
#include "proc/remap/plane_sampling.h"
#include "proc/remap/tile.h"

namespace orbwatch::remap {

/// What is done where a view is smaller than its source: the pixels of a tile are means of four
/// samples of a source that was halved so often; or kPlain, they are single samples of the source.
using Halves = int;
inline constexpr Halves kPlain = -1;

/// Samples tiles of one plane, or of what else is sampled together. Refers to the pictures; holds
/// all that is the same for all tiles. Reentrant.
class PlaneSampler {
 public:
  PlaneSampler() = default;
  /// `pictures`: the source, and its halves.
  PlaneSampler(const PlaneSampling& sampling, std::span<const Picture> pictures,
               const Kernel& kernel);

  const PlaneSampling& sampling() const { return sampling_; }
  int columns() const { return columns_; }                    ///< of a tile, in pixels of the plane
  int rows() const { return rows_; }                          ///< of a tile
  int pixel_bytes() const { return pixel_bytes_; }            ///< of what is written
  int tile_bytes() const { return columns_ * pixel_bytes_; }  ///< of a row of a tile

  /// Fills a target, blocks of a tile, from a patch of the picture, or of the half of it that
  /// `halves` names. False, and then the target is to be sampled in another way, if there is no
  /// kernel for it or blocks do not fit a kernel. For interior tiles only, see Tile.
  [[gnu::always_inline]] bool sample(const Patch& patch, Halves halves,
                                     const TargetPlane& target) const {
    if (kernel_ == nullptr) return false;
    if (sampling_.x == Siting::Full) return sample_patch(patch, halves, target);
    return sample_patch(on_plane(patch, sampling_), halves, target);
  }

  /// Fills a target pixel by pixel, from coordinates in the plane of the picture or of that half.
  void sample(const CoordinateTile& coordinates, Halves halves, std::uint8_t black,
              const TargetPlane& target) const;

 private:
  // What most tiles go through is inlined, and what few need is not: it would cost all of them
  // registers.
  [[gnu::always_inline]] bool sample_patch(const Patch& patch, Halves halves,
                                           const TargetPlane& target) const {
    return (halves == kPlain && sample_blocks(patch, sources_[0], target)) ||
           sample_finely(patch, halves, target);
  }
  [[gnu::always_inline]] bool sample_blocks(const Patch& patch, const SourcePlane& source,
                                            const TargetPlane& target) const {
    const auto blocks = [](int pixels) { return static_cast<unsigned>(pixels) / kBlock; };
    BlockMap map;
    if (!map.fit(patch, blocks(target.columns), blocks(target.rows), rounding_)) return false;
    kernel_({map, source.data, source.stride, target.data, target.stride});
    return true;
  }
  bool sample_finely(const Patch& patch, Halves halves, const TargetPlane& target) const;
  bool sample_steep(const Patch& patch, const SourcePlane& source, const TargetPlane& target) const;
  bool sample_half_rows(const Patch& patch, const SourcePlane& source,
                        const TargetPlane& target) const;
  bool sample_half_columns(const Patch& patch, const SourcePlane& source,
                           const TargetPlane& target) const;

  PlaneSampling sampling_{};
  Kernel::Tile kernel_ = nullptr;  ///< if there is one for the layout
  Both rounding_{};                ///< see BlockMap
  int columns_ = 0, rows_ = 0, pixel_bytes_ = 0;
  std::array<SourcePlane, kMaxLevel> sources_;  ///< by how often the source was halved
};

}  // namespace orbwatch::remap
