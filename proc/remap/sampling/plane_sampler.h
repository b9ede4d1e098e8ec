// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "proc/image/picture.h"
#include "proc/remap/grid/coordinate.h"
#include "proc/remap/grid/patch.h"
#include "proc/remap/grid/source_area.h"
#include "proc/remap/grid/tile.h"
#include "proc/remap/kernel/kernel.h"
#include "proc/remap/kernel/kernel_map.h"
#include "proc/remap/kernel/layout.h"
#include "proc/remap/sampling/downsampling.h"
#include "proc/remap/sampling/plane_map.h"
#include "proc/remap/sampling/plane_sampling.h"

namespace orbwatch::remap {

/// Samples a target pixel by pixel at integer X, Y of a patch, also at the source's borders, where
/// its outermost pixels are repeated. Reentrant.
void sample_points(const Kernel& kernel, Layout layout, const Patch& patch,
                   const SourcePlane& source, const TargetPlane& target);

/// The same at coordinates, for any map. Undefined pixels become `black`.
void sample_points(const Kernel& kernel, Layout layout, const CoordinateTile& coordinates,
                   std::uint8_t black, const SourcePlane& source, const TargetPlane& target);

/// The longest step along an axis, in pixels of the level that is read, for a single sample along
/// it where pixels are means. A bilinear sample is itself a mean, and blurs: of a picture as a
/// camera makes it, a single one is closer to the mean over the view's pixel up to this step, and
/// two are beyond. Sharpening compensates that blur.
inline constexpr double kLongestStep = 1.7;
inline constexpr double kLongestSharpenedStep = 0.75;

/// Bytes that one request loads into the cache.
inline constexpr int kCacheLine = 64;

/// Parameters for reading a tile's source.
struct Reading {
  bool averaged = false;    ///< pixels are means of several samples: the view is smaller
  int mip_level = 0;        ///< level of the source that is sampled
  bool in_windows = false;  ///< kernels may read windows around every pixel, see
                            ///< Tile::interior
};

/// Samples tiles of one PlaneSampling. Refers to the pictures; holds the data that all tiles have
/// in common. Reentrant.
class PlaneSampler {
 public:
  PlaneSampler() = default;
  /// `pictures`: the source's mip levels.
  PlaneSampler(const PlaneSampling& sampling, std::span<const Picture> pictures,
               const Kernel& kernel);

  const PlaneSampling& sampling() const { return sampling_; }
  int columns() const { return columns_; }          ///< width of a tile, in pixels of the plane
  int rows() const { return rows_; }                ///< height of a tile
  int pixel_bytes() const { return pixel_bytes_; }  ///< bytes of an output pixel
  int tile_bytes() const { return tile_bytes_; }    ///< bytes of a tile's row
  bool has_blocks() const { return block_kernel_ != nullptr; }

  /// Prefetches the samples of an area of the picture.
  void fetch(const SourceArea& area) const;

  /// Fills a target, of 2, 4, 8 or 16 pixels each way, from a patch of the mip level that is read.
  void sample(const Patch& patch, Reading reading, const TargetPlane& target) const;

  /// The same for most tiles: not averaged, in windows, of a layout that has_blocks(), at least 8
  /// pixels wide. Inlined alone: the rarer paths would cost these tiles registers.
  [[gnu::always_inline]] void sample_blocks(const Patch& patch, const TargetPlane& target) const {
    const auto sample = [&](const Patch& map) __attribute__((always_inline)) {
      if (!sample_blocks(map, sources_[0], target)) sample_steep(map, sources_[0], target);
    };
    sampling_.x == Siting::Full ? sample(patch) : sample(on_plane(patch, sampling_));
  }

  /// Fills a target pixel by pixel, from coordinates in the mip level that is read. Undefined
  /// pixels become `black`.
  void sample(const CoordinateTile& coordinates, Reading reading, std::uint8_t black,
              const TargetPlane& target) const;

 private:
  [[gnu::always_inline]] bool sample_blocks(const Patch& patch, const SourcePlane& source,
                                            const TargetPlane& target) const {
    BlockMap map;
    if (!map.fit(patch, target.columns, target.rows, rounding_)) return false;
    block_kernel_({map, source, target});
    return true;
  }
  TwiceAlong twice_along(const Patch& patch, const TargetPlane& target) const;
  void sample_once(const Patch& patch, bool in_windows, const SourcePlane& source,
                   const TargetPlane& target) const;
  bool sample_means(const Patch& patch, TwiceAlong twice, const Reading& reading,
                    const TargetPlane& target) const;
  bool sample_column_of_means(const Patch& fine, TwiceAlong twice, const Reading& reading,
                              const TargetPlane& target) const;
  bool average_blocks(const Patch& fine, TwiceAlong twice, const Reading& reading,
                      const TargetPlane& target) const;
  TargetPlane samples_of(const TargetPlane& target, TwiceAlong twice, OversampledTile& tile) const;
  bool keep_half(Kernel::Tile kernel, const Patch& patch, const SourcePlane& source,
                 const TargetPlane& fine, const TargetPlane& kept) const;
  void sample_steep(const Patch& patch, const SourcePlane& source, const TargetPlane& target) const;
  bool sample_half_rows(const Patch& patch, const SourcePlane& source,
                        const TargetPlane& target) const;
  bool sample_half_columns(const Patch& patch, const SourcePlane& source,
                           const TargetPlane& target) const;

  PlaneSampling sampling_{};
  const Kernel* kernel_ = nullptr;
  /// The kernel's functions for the layout; null if it has none.
  Kernel::Tile block_kernel_ = nullptr, even_columns_ = nullptr, even_rows_ = nullptr;
  Kernel::Tile means_along_x_ = nullptr, means_along_y_ = nullptr, means_of_four_ = nullptr;
  Uv64 rounding_{};  ///< see BlockMap
  int columns_ = 0, rows_ = 0, pixel_bytes_ = 0, tile_bytes_ = 0;
  std::int64_t longest_step2_ = 0;  ///< square of kLongestStep or kLongestSharpenedStep, Q40
  std::array<SourcePlane, kMaxLevel> sources_;  ///< one per mip level
};

}  // namespace orbwatch::remap
