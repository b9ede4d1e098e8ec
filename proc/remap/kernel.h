#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "proc/image/result.h"
#include "proc/remap/block_map.h"
#include "proc/remap/plane.h"
#include "proc/remap/point_map.h"

namespace orbwatch::remap {

/// Which samples of a plane a kernel takes, and what it writes: those samples side by side.
enum class Layout : std::uint8_t {
  One8,         ///< grey, Y, U or V
  Two8,         ///< U V pairs
  Three8,       ///< R G B
  Four8,        ///< B G R A
  FirstOfTwo8,  ///< Y of Y U Y V
  OddOfFour8,   ///< U and V of Y U Y V, a pixel of which is four samples
  One16,        ///< 16 bit
  Three16,      ///< R G B of 16 bit: of stored pictures, not of cameras; kernels do without it
};
inline constexpr std::size_t kLayouts = 8;
inline constexpr std::size_t kKernelLayouts = 7;

/// The facts about a Layout.
struct LayoutInfo {
  int pixel_bytes;   ///< from pixel to pixel in the source
  int first;         ///< the sample that is taken first
  int every;         ///< from there, each sample so many further
  int samples;       ///< taken per pixel
  int sample_bytes;  ///< 1 or 2
  constexpr int out_bytes() const { return samples * sample_bytes; }
};
inline constexpr std::array<LayoutInfo, kLayouts> kLayoutInfo{{
    {1, 0, 1, 1, 1},
    {2, 0, 1, 2, 1},
    {3, 0, 1, 3, 1},
    {4, 0, 1, 4, 1},
    {2, 0, 1, 1, 1},
    {4, 1, 2, 2, 1},
    {2, 0, 1, 1, 2},
    {6, 0, 1, 3, 2},
}};
constexpr const LayoutInfo& info(Layout layout) {
  return kLayoutInfo[static_cast<std::size_t>(layout)];
}

/// The layout of what is written for `layout`: the same samples without those left out.
constexpr Layout packed(Layout layout) {
  if (layout == Layout::FirstOfTwo8) return Layout::One8;
  return layout == Layout::OddOfFour8 ? Layout::Two8 : layout;
}

/// A target of 4x4 pixel blocks to be sampled from one plane.
struct TileJob {
  const BlockMap& map;
  const SourcePlane& source;
  const TargetPlane& target;
};

/// Pixels to be sampled from one plane, each at a place of its own. Beyond the plane's border its
/// outermost pixels go on.
struct PointJob {
  const Places& places;  ///< of the target's pixels
  const SourcePlane& source;
  const TargetPlane& target;
};

/// One implementation of the remap for one instruction set. Every kernel gives the same bytes as
/// the scalar one, which is their specification.
struct Kernel {
  using Tile = void (*)(const TileJob&);
  using Locate = void (*)(const PointMap&, int columns, int rows, Places&);
  using Points = void (*)(const PointJob&);

  std::string_view name;  ///< scalar, neon, avx2, avx512
  /// By Layout. Fills all blocks of the job. Every 8x8 source pixels from a block's origin are
  /// read, so they must be in the picture. Reentrant.
  std::array<Tile, kKernelLayouts> tiles;
  /// Where the pixels of a rectangle lie; `columns` is a power of two. Reentrant.
  Locate locate;
  /// By Layout. Fills the job's target: for any map, at borders too. The source is at least 2x2
  /// pixels large, but for the scalar kernel.
  /// Reentrant.
  std::array<Points, kLayouts> point_tiles;

  void tile(Layout layout, const TileJob& job) const {
    tiles[static_cast<std::size_t>(layout)](job);
  }
  void sample_points(Layout layout, const PointJob& job) const {
    point_tiles[static_cast<std::size_t>(layout)](job);
  }
};

/// The kernels that this machine can run, the fastest one last.
std::span<const Kernel* const> kernels();

/// The kernel of that name, or the reason why this machine cannot run it.
Result<const Kernel*> find_kernel(std::string_view name);

/// The kernel that the environment variable ORBWATCH_ISA names, or why there is none; the fastest
/// one if it is not set. A program asks once, when it starts.
Result<const Kernel*> requested_kernel();

/// The same, chosen at the first call; the fastest one where the request cannot be met.
const Kernel& default_kernel();

}  // namespace orbwatch::remap
