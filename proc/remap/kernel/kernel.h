// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <utility>

#include "proc/image/image_view.h"
#include "proc/image/result.h"
#include "proc/remap/colour/colour_table.h"
#include "proc/remap/colour/planar_tile.h"
#include "proc/remap/colour/yuv420_tile.h"
#include "proc/remap/colour/yuv_rows.h"
#include "proc/remap/kernel/kernel_map.h"
#include "proc/remap/kernel/layout.h"
#include "proc/remap/kernel/mixed_tile.h"

namespace orbwatch::remap {

/// A target of 4x4 pixel blocks to be sampled from one plane.
struct TileJob {
  const BlockMap& map;
  const SourcePlane& source;
  const TargetPlane& target;
};

/// Pixels to be sampled from one plane, each at its own place. Beyond the plane's border its
/// outermost pixels are repeated.
struct PointJob {
  const Places& places;  ///< places of the target's pixels
  const SourcePlane& source;
  const TargetPlane& target;
};

/// True if a kernel of this processor may have `find_entries` and `write_rgb`; if none has, tiles
/// skip the check.
#if defined(__x86_64__) || defined(__aarch64__)
inline constexpr bool kKernelsConvert = true;
#else
inline constexpr bool kKernelsConvert = false;
#endif

/// One implementation of the remap for one instruction set. Every kernel produces the same bytes as
/// the scalar one, their specification.
struct Kernel {
  using Tile = void (*)(const TileJob&);
  using Locate = void (*)(const PointMap&, int columns, int rows, Places&);
  using Points = void (*)(const PointJob&);
  using FindEntries = void (*)(const ValueScale& scale,
                               const ImageView<const std::uint16_t>& values, std::uint8_t* entries);
  using LookUp = void (*)(const ColourTable& table, const IndexRuns& runs,
                          const ImageView<std::uint8_t>& out);
  using LookUpPlanes = void (*)(const ColourTable& table, const std::uint8_t* indices,
                                PlanarTile& out);
  using LookUpYuv420 = void (*)(const ColourTable& table, const IndexRuns& runs,
                                const Yuv420Planes& out);
  using WriteRgb = void (*)(const YuvRows& yuv, const YuvCoefficients& coefficients,
                            std::uint8_t* out, std::ptrdiff_t stride);
  using Mix = void (*)(std::span<const MixedTile> tiles, const ImageView<std::uint8_t>& out);
  using MixYuv420 = void (*)(std::span<const MixedTile> tiles, const Yuv420Planes& out);

  std::string_view name;
  /// Functions indexed by Layout that fill all blocks of the job. Each reads 8x8 source pixels from
  /// each block's origin, so these must lie in the picture. Reentrant.
  std::array<Tile, kKernelLayouts> tiles;
  /// Computes the places of a rectangle's pixels; `columns` is a power of two. Reentrant.
  Locate locate;
  /// Functions indexed by Layout that fill the job's target: for any map, at borders too. The
  /// source is at least 2x2 pixels large, except for the scalar kernel. Reentrant.
  std::array<Points, kLayouts> points;
  /// Mixes whole tiles that 1 to kMaxSources sources see everywhere, and whose shares add up to 255
  /// in each corner. Between the corners the sum of the shares of the first n sources is
  /// interpolated linearly and rounded, for each n, so that they add up to 255 in every pixel too;
  /// the mean by these is rounded to nearest. `out` is one tile of 1 or 3 channels. Reentrant.
  Mix mix;
  /// The same for samples of PlanarTile; `out` has 3 channels. Null where pixels are mixed as fast,
  /// and made faster, as they lie in a view. Reentrant.
  Mix mix_planes = nullptr;
  /// The same for samples of Yuv420Tile. The sums of shares for a sample of chroma are the means of
  /// those of its four pixels, rounded to nearest. Reentrant.
  MixYuv420 mix_yuv420;
  /// Writes the colours of runs of kRun indices into rows of `out`, which has the table's channels.
  /// Reentrant.
  LookUp look_up;
  /// The same for kTile runs that follow one another, into a tile in planes. Set with mix_planes.
  /// Reentrant.
  LookUpPlanes look_up_planes = nullptr;
  /// Writes a tile from kTile runs of kRun indices into a table of Y, U and V: the chroma of each
  /// two by two pixels is the mean of theirs, rounded to nearest. Reentrant.
  LookUpYuv420 look_up_yuv420;
  /// Writes the table indices of runs of values, at most kTile of them, run after run. Null where
  /// compilers generate equally good code for ColourMap's own loop. Reentrant.
  FindEntries find_entries = nullptr;
  /// Converts a whole tile like YuvToRgb. Null where compilers generate equally good code for that.
  /// Reentrant.
  WriteRgb write_rgb = nullptr;
  /// Variants of `tiles` for a map at half steps along an axis: columns, or rows, 0, 2, 4 .. of the
  /// result become the target's. `blocks_x`, or `blocks_y`, is even. Null: to be made by `tiles`.
  /// Reentrant.
  std::array<Tile, kKernelLayouts> even_columns{};
  std::array<Tile, kKernelLayouts> even_rows{};
  /// Variants of `tiles` for a map at half steps along an axis or both: the target's pixels are the
  /// means of two results in a row, of two in a column, or of 2x2, rounded to nearest. `blocks_x`
  /// is 4. Null: to be made by `tiles`. Reentrant.
  std::array<Tile, kKernelLayouts> means_along_x{};
  std::array<Tile, kKernelLayouts> means_along_y{};
  std::array<Tile, kKernelLayouts> means_of_four{};
  /// True if tiles should prefetch their source, where they read much.
  bool fetches_ahead = false;

  void sample_tile(Layout layout, const TileJob& job) const {
    tiles[static_cast<std::size_t>(layout)](job);
  }
  void sample_points(Layout layout, const PointJob& job) const {
    points[static_cast<std::size_t>(layout)](job);
  }
};

/// An array of the results of `of` for each of the first `count` layouts, which is its template
/// argument.
template <std::size_t count, class Of>
constexpr auto by_layout(const Of& of) {
  return [&]<std::size_t... n>(std::index_sequence<n...>) {
    return std::array{of.template operator()<Layout{n}>()...};
  }
  (std::make_index_sequence<count>());
}

/// The kernels that this machine can run, slowest first.
std::span<const Kernel* const> kernels();

/// The first of kernels().
const Kernel& scalar_kernel();

/// The kernel called `name`. Error: unknown, or not for this machine.
Result<const Kernel*> find_kernel(std::string_view name);

/// The kernel named by the environment variable ORBWATCH_ISA; the fastest one if it is not set.
/// Error: that of find_kernel(). For the start of a program.
Result<const Kernel*> requested_kernel();

/// The same, chosen at the first call; the fastest one if the request cannot be met.
const Kernel& default_kernel();

}  // namespace orbwatch::remap
