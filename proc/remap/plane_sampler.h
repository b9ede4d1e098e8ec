#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "proc/image/picture.h"
#include "proc/remap/block_map.h"
#include "proc/remap/coordinate.h"
#include "proc/remap/kernel.h"
#include "proc/remap/plane.h"
#include "proc/remap/plane_map.h"
#include "proc/remap/plane_sampling.h"
#include "proc/remap/tile.h"

namespace orbwatch::remap {

/// How a tile's source is read.
struct Reading {
  /// What `halves` is where pixels are single samples of the source.
  static constexpr int kPlain = -1;

  /// Where the view is smaller than the source, pixels are means of four samples of a source that
  /// was halved so often.
  int halves = kPlain;
  bool in_windows = false;  ///< kernels may read windows around every pixel, see Tile::interior
};

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

  /// Fills a target, of 4, 8 or 16 pixels each way, from a patch of the picture, or of the half of
  /// it that is read.
  [[gnu::always_inline]] void sample(const Patch& patch, Reading reading,
                                     const TargetPlane& target) const {
    if (sampling_.x == Siting::Full) return sample_patch(patch, reading, target);
    sample_patch(on_plane(patch, sampling_), reading, target);
  }

  /// Fills a target pixel by pixel, from coordinates in the picture or in that half of it.
  /// Undefined pixels become `black`.
  void sample(const CoordinateTile& coordinates, Reading reading, std::uint8_t black,
              const TargetPlane& target) const;

 private:
  // What most tiles go through is inlined, and what few need is not: it would cost all of them
  // registers.
  [[gnu::always_inline]] void sample_patch(const Patch& patch, Reading reading,
                                           const TargetPlane& target) const {
    const bool simple = reading.halves == Reading::kPlain && may_use_blocks(reading, target);
    if (!simple || !sample_blocks(patch, sources_[0], target)) {
      sample_finely(patch, reading, target);
    }
  }
  [[gnu::always_inline]] bool may_use_blocks(Reading reading, const TargetPlane& target) const {
    return reading.in_windows && block_kernel_ != nullptr && target.columns >= 2 * kBlock;
  }
  [[gnu::always_inline]] bool sample_blocks(const Patch& patch, const SourcePlane& source,
                                            const TargetPlane& target) const {
    const auto blocks = [](int pixels) { return static_cast<unsigned>(pixels) / kBlock; };
    BlockMap map;
    if (!map.fit(patch, blocks(target.columns), blocks(target.rows), rounding_)) return false;
    block_kernel_({map, source.data, source.stride, target.data, target.stride});
    return true;
  }
  void sample_finely(const Patch& patch, Reading reading, const TargetPlane& target) const;
  void sample_steep(const Patch& patch, Reading reading, const SourcePlane& source,
                    const TargetPlane& target) const;
  bool sample_half_rows(const Patch& patch, const SourcePlane& source,
                        const TargetPlane& target) const;
  bool sample_half_columns(const Patch& patch, const SourcePlane& source,
                           const TargetPlane& target) const;

  PlaneSampling sampling_{};
  const Kernel* kernel_ = nullptr;
  Kernel::Tile block_kernel_ = nullptr;  ///< its one for the layout, if there is one
  Both rounding_{};                      ///< see BlockMap
  int columns_ = 0, rows_ = 0, pixel_bytes_ = 0;
  std::array<SourcePlane, kMaxLevel> sources_;  ///< by how often the source was halved
};

}  // namespace orbwatch::remap
