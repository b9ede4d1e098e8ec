#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "proc/remap/block_map.h"
#include "proc/remap/kernel.h"

// What the kernels share. They are compiled for different machines, so everything here must be
// inlined or have internal linkage: else the linker might keep the copy that not every machine
// runs.

namespace orbwatch::remap {

/// Steps one axis of a WindowWalk from block to block along a row of blocks.
class AxisWalk {
 public:
  /// Axis 0 or 1, u or v.
  [[gnu::always_inline]] AxisWalk(const WindowWalk& walk, int axis, int row)
      : value_(walk.value[axis] + row * walk.step_y[axis] + pairs(row) * walk.yy[axis]),
        step_(walk.step_x[axis] + row * walk.xy[axis]),
        growth_(walk.xx[axis]) {}

  /// Where the window of the current block begins, source pixels.
  [[gnu::always_inline]] std::ptrdiff_t window() const { return value_ >> 32; }
  /// The block's place in its window, with so many bits.
  template <int bits>
  [[gnu::always_inline]] std::uint16_t place() const {
    return static_cast<std::uint16_t>(static_cast<std::uint32_t>(value_) >> (32 - bits));
  }
  [[gnu::always_inline]] void next() {
    value_ += step_;
    step_ += growth_;
  }

 private:
  [[gnu::always_inline]] static int pairs(int n) { return n * (n - 1) / 2; }

  std::int64_t value_;
  std::int64_t step_;
  std::int64_t growth_;
};

/// Goes through a tile's blocks. An instruction set gives, all in one struct `Isa`:
///   Shape           the lanes of both axes of the current block, without its place; made from a
///                   BlockMap; next_block() goes one block on, next_row() to the next row's first
///   sample<layout>  one block from its window into `out`
template <class Isa, Layout layout>
void walk_tile(const TileJob& job) {
  const BlockMap& map = job.map;
  typename Isa::Shape shape(map);
  for (int row = 0; row < map.blocks_y; ++row) {
    AxisWalk u(map.windows, 0, row);
    AxisWalk v(map.windows, 1, row);
    std::uint8_t* out = job.target.data + row * kBlock * job.target.stride;
    for (int block = 0; block < map.blocks_x; ++block) {
      const std::uint8_t* window =
          job.source.data + v.window() * job.source.stride + u.window() * info(layout).pixel_bytes;
      Isa::template sample<layout>(shape, u.place<kFractionBits>(), v.place<kRowFractionBits>(),
                                   window, job.source.stride, out, job.target.stride);
      u.next();
      v.next();
      shape.next_block();
      out += kBlock * info(layout).out_bytes();
    }
    shape.next_row();
  }
}

/// By layout.
template <class Isa>
inline constexpr std::array<Kernel::Tile, kKernelLayouts> kBlockWalks{
    walk_tile<Isa, Layout::One8>,        walk_tile<Isa, Layout::Two8>,
    walk_tile<Isa, Layout::Three8>,      walk_tile<Isa, Layout::Four8>,
    walk_tile<Isa, Layout::FirstOfTwo8>, walk_tile<Isa, Layout::OddOfFour8>,
    walk_tile<Isa, Layout::One16>};

}  // namespace orbwatch::remap
