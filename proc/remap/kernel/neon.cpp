// SPDX-License-Identifier: Apache-2.0
// The kernel for NEON of aarch64. A window of 8x8 samples is four registers, so that one table
// lookup fetches a sample for each of a block's 16 pixels. Samples that are interleaved in the
// source are split into one such table each when they are loaded.
//
// The number of instructions is the limit, so the code minimises it: everything between a block's
// place and its stores is 16 pixels wide, and everything that a row of blocks needs only once is
// done per row.

#include <arm_neon.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

#include "proc/remap/kernel/bilinear.h"
#include "proc/remap/kernel/look_up_neon.h"
#include "proc/remap/kernel/mix_neon.h"
#include "proc/remap/kernel/neon_means.h"
#include "proc/remap/kernel/neon_memory.h"
#include "proc/remap/kernel/point_walk.h"
#include "proc/remap/kernel/tile_mix.h"
#include "proc/remap/kernel/yuv420_mix.h"

namespace orbwatch::remap::neon {
namespace {

/// Forces `value` into a register here: g++ would regroup sums, or postpone the last instruction of
/// a block and keep its inputs alive.
template <class T>
[[gnu::always_inline]] inline void settle(T*& value) {
  asm("" : "+r"(value));
}
template <class T>
requires(sizeof(T) == sizeof(uint8x16_t)) [[gnu::always_inline]] inline void settle(T& value) {
  asm("" : "+w"(value));
}

// ---- Lanes: where the pixels lie ----

/// A value for each pixel of a block: of its rows 0 and 1, and of 2 and 3.
struct Lanes {
  uint16x8_t upper, lower;
};
[[gnu::always_inline]] inline Lanes operator+(Lanes a, Lanes b) {
  return {vaddq_u16(a.upper, b.upper), vaddq_u16(a.lower, b.lower)};
}
[[gnu::always_inline]] inline Lanes operator+(Lanes a, uint16x8_t b) {
  return {vaddq_u16(a.upper, b), vaddq_u16(a.lower, b)};
}

constexpr std::array<std::int16_t, 8> kColumns{0, 1, 2, 3, 0, 1, 2, 3};
constexpr std::array<std::int16_t, 8> kUpperRows{0, 0, 0, 0, 1, 1, 1, 1};

/// One axis of the pixels of a tile's blocks, see LaneShape: those of the current block without its
/// place, and the steps to the next block and to the first one of the next row.
template <int blocks>
class AxisLanes {
 public:
  /// Axis 0 or 1, u or v. `shift`: number of fraction bits that the lanes have less than Q13.
  template <int axis, int shift>
  [[gnu::always_inline]] static AxisLanes make(const LaneShape& shape) {
    static_assert(offsetof(LaneShape, slope_y) == 4 && offsetof(LaneShape, twice_xx) == 8 &&
                  offsetof(LaneShape, twice_yy) == 12 && offsetof(LaneShape, offset) == 20);
    const int16x8_t s = vld1q_s16(&shape.slope_x.u);
    const int16x4_t last = vld1_s16(&shape.xy.u);
    const int16x8_t column = vld1q_s16(kColumns.data());
    const int16x8_t first = vmlaq_laneq_s16(vdupq_lane_s16(last, 2 + axis), column, s, axis);
    int16x8_t upper_rows = vld1q_s16(kUpperRows.data());
    settle(upper_rows);
    const Half<axis> upper(s, last, first, column, upper_rows);
    const Half<axis> lower(s, last, first, column, vaddq_s16(upper_rows, vdupq_n_s16(2)));
    AxisLanes lanes;
    if constexpr (shift == 0) {
      lanes.current_ = {vreinterpretq_u16_s16(upper.start), vreinterpretq_u16_s16(lower.start)};
      lanes.set_steps(upper.along_x, lower.along_x, upper.along_y, lower.along_y);
    } else {
      lanes.current_ = {vrshrq_n_u16(vreinterpretq_u16_s16(upper.start), shift),
                        vrshrq_n_u16(vreinterpretq_u16_s16(lower.start), shift)};
      lanes.set_steps(vrshrq_n_s16(upper.along_x, shift), vrshrq_n_s16(lower.along_x, shift),
                      vrshrq_n_s16(upper.along_y, shift), vrshrq_n_s16(lower.along_y, shift));
    }
    return lanes;
  }

  [[gnu::always_inline]] Lanes current() const { return current_; }
  [[gnu::always_inline]] void next_block() { current_ = current_ + next_block_; }
  [[gnu::always_inline]] void next_row() { current_ = current_ + next_row_; }

 private:
  template <int axis>
  struct Half {
    [[gnu::always_inline]] Half(int16x8_t s, int16x4_t last, int16x8_t first, int16x8_t column,
                                int16x8_t row)
        : along_x(vrshrq_n_s16(
              vmlaq_lane_s16(vmulq_laneq_s16(column, s, 4 + axis), row, last, axis), 3)),
          along_y(vrshrq_n_s16(
              vmlaq_laneq_s16(vmulq_lane_s16(column, last, axis), row, s, 6 + axis), 3)),
          start(vrsraq_n_s16(vmlaq_laneq_s16(first, row, s, 2 + axis),
                             vmlaq_s16(vmulq_s16(column, along_x), row, along_y), 3)) {}
    int16x8_t along_x, along_y, start;
  };
  [[gnu::always_inline]] void set_steps(int16x8_t upper_x, int16x8_t lower_x, int16x8_t upper_y,
                                        int16x8_t lower_y) {
    const int16x8_t back = vdupq_n_s16(blocks - 1);
    next_block_ = {vreinterpretq_u16_s16(upper_x), vreinterpretq_u16_s16(lower_x)};
    next_row_ = {vreinterpretq_u16_s16(vmlsq_s16(upper_y, upper_x, back)),
                 vreinterpretq_u16_s16(vmlsq_s16(lower_y, lower_x, back))};
  }

  Lanes current_, next_block_, next_row_;
};

/// Positions of the blocks' windows, see WindowWalk: u in the lower half of a register, v in the
/// upper.
template <int blocks>
class Windows {
 public:
  [[gnu::always_inline]] explicit Windows(const WindowWalk& walk)
      : value_(load(walk.value)),
        step_(load(walk.step_x)),
        growth_(load(walk.xx)),
        // Steps back (blocks - 1) times from the row's last block; each has grown by one growth
        // more.
        next_row_(vsubq_s64(load(walk.step_y), back(vaddq_s64(step_, half_back(growth_))))),
        next_row_step_(vsubq_s64(load(walk.xy), back(growth_))),
        next_row_growth_(vsubq_s64(load(walk.yy), back(load(walk.xy)))) {}

  [[gnu::always_inline]] void next_block() {
    value_ = vaddq_s64(value_, step_);
    step_ = vaddq_s64(step_, growth_);
  }
  [[gnu::always_inline]] void next_row() {
    value_ = vaddq_s64(value_, next_row_);
    step_ = vaddq_s64(step_, next_row_step_);
    next_row_ = vaddq_s64(next_row_, next_row_growth_);
  }

  /// The current block's window in a source.
  template <int pixel_bytes>
  [[gnu::always_inline]] const std::uint8_t* window(const std::uint8_t* source,
                                                    std::int32_t stride) const {
    const int32x4_t words = vreinterpretq_s32_s64(value_);
    const std::uint8_t* line = source + std::int64_t{vgetq_lane_s32(words, 3)} * stride;
    settle(line);
    return line + std::ptrdiff_t{vgetq_lane_s32(words, 1)} * pixel_bytes;
  }
  /// The block's place in its window: u in lane 0, v in lane 4.
  [[gnu::always_inline]] uint16x8_t place() const {
    constexpr std::array<std::int32_t, 4> kShift{kFractionBits - 32, 0, kRowFractionBits - 32, 0};
    return vreinterpretq_u16_u32(
        vshlq_u32(vreinterpretq_u32_s64(value_), vld1q_s32(kShift.data())));
  }

 private:
  [[gnu::always_inline]] static int64x2_t load(const Uv64& pair) {
    return reinterpret_cast<int64x2_t>(pair);
  }
  /// Multiplies by (blocks - 1); half_back() by (blocks - 2) / 2, or by 0.
  [[gnu::always_inline]] static int64x2_t back(int64x2_t step) {
    static_assert(blocks == 1 || blocks == 2 || blocks == 4);
    if constexpr (blocks == 1) return vdupq_n_s64(0);
    return blocks == 2 ? step : vaddq_s64(vaddq_s64(step, step), step);
  }
  [[gnu::always_inline]] static int64x2_t half_back(int64x2_t step) {
    return blocks <= 2 ? vdupq_n_s64(0) : step;
  }

  int64x2_t value_, step_, growth_;
  int64x2_t next_row_, next_row_step_, next_row_growth_;
};

// ---- Interpolation, see bilinear.h ----

/// The index of each pixel's upper left sample in the table.
[[gnu::always_inline]] inline uint8x16_t table_index(Lanes u, Lanes v) {
  static_assert(kRowCentre % 256 == 0);
  static_assert(kFractionBits == 13 && kRowFractionBits == 11, "rows' bits before columns'");
  const auto whole = [](Lanes lanes) {
    return vuzp2q_u8(vreinterpretq_u8_u16(lanes.upper), vreinterpretq_u8_u16(lanes.lower));
  };
  return vsriq_n_u8(vsubq_u8(whole(v), vdupq_n_u8(kRowCentre / 256)), whole(u), 5);
}

/// A table's samples around each pixel.
struct Neighbourhood {
  [[gnu::always_inline]] Neighbourhood(const uint8x16x4_t& table, uint8x16_t index) {
    const uint8x16_t one = vdupq_n_u8(1);
    upper_left = vqtbl4q_u8(table, index);
    upper_right = vqtbl4q_u8(table, vaddq_u8(index, one));
    uint8x16_t below = vaddq_u8(index, vdupq_n_u8(kWindow));
    lower_left = vqtbl4q_u8(table, below);
    settle(below);
    lower_right = vqtbl4q_u8(table, vaddq_u8(below, one));
  }
  uint8x16_t upper_left, upper_right, lower_left, lower_right;
};

/// Weights of two neighbours, Q7.
struct Weights {
  /// `bits`: number of the lanes' fraction bits.
  template <int bits>
  [[gnu::always_inline]] static Weights of(Lanes lanes) {
    constexpr int kShift = bits - kWeightBits - 1;
    const uint8x16_t fraction =
        vshrn_high_n_u16(vshrn_n_u16(lanes.upper, kShift), lanes.lower, kShift);
    const uint8x16_t second = vshrq_n_u8(fraction, 1);
    return {vsubq_u8(vdupq_n_u8(kUnitWeight), second), second};
  }
  uint8x16_t first, second;
};

[[gnu::always_inline]] inline uint8x16_t interpolate(const Neighbourhood& n, Weights u, Lanes v) {
  const auto fraction = [](uint16x8_t lanes) {
    return vreinterpretq_s16_u16(vshlq_n_u16(lanes, 16 - kRowFractionBits));
  };
  const auto shifted = [](uint16x8_t top, uint16x8_t bottom, int16x8_t weight) {
    const int16x8_t difference = vreinterpretq_s16_u16(vsubq_u16(bottom, top));
    return vreinterpretq_u16_s16(vqrdmulhq_s16(difference, weight));
  };
  const auto low = [&](uint8x16_t left, uint8x16_t right) {
    return vmlal_u8(vmull_u8(vget_low_u8(left), vget_low_u8(u.first)), vget_low_u8(right),
                    vget_low_u8(u.second));
  };
  const auto high = [&](uint8x16_t left, uint8x16_t right) {
    return vmlal_high_u8(vmull_high_u8(left, u.first), right, u.second);
  };
  const uint16x8_t top0 = low(n.upper_left, n.upper_right);
  const uint16x8_t bottom0 = low(n.lower_left, n.lower_right);
  const uint16x8_t top1 = high(n.upper_left, n.upper_right);
  const uint16x8_t bottom1 = high(n.lower_left, n.lower_right);
  const uint8x8_t upper =
      vraddhn_u16(vaddq_u16(top0, bottom0), shifted(top0, bottom0, fraction(v.upper)));
  uint8x16_t sample =
      vraddhn_high_u16(upper, vaddq_u16(top1, bottom1), shifted(top1, bottom1, fraction(v.lower)));
  settle(sample);
  return sample;
}

/// The four neighbours' weights, Q14, for eight pixels.
struct Products {
  uint16x8_t upper_left, upper_right, lower_left, lower_right;
};

/// Interpolates 16 bit samples of eight pixels, whose lower and upper bytes have been combined.
[[gnu::always_inline]] inline uint8x16_t interpolate(uint16x8_t a, uint16x8_t b, uint16x8_t c,
                                                     uint16x8_t d, const Products& w) {
  uint32x4_t low = vmull_u16(vget_low_u16(a), vget_low_u16(w.upper_left));
  uint32x4_t high = vmull_high_u16(a, w.upper_left);
  low = vmlal_u16(low, vget_low_u16(b), vget_low_u16(w.upper_right));
  high = vmlal_high_u16(high, b, w.upper_right);
  low = vmlal_u16(low, vget_low_u16(c), vget_low_u16(w.lower_left));
  high = vmlal_high_u16(high, c, w.lower_left);
  low = vmlal_u16(low, vget_low_u16(d), vget_low_u16(w.lower_right));
  high = vmlal_high_u16(high, d, w.lower_right);
  return vreinterpretq_u8_u16(
      vrshrn_high_n_u32(vrshrn_n_u32(low, 2 * kWeightBits), high, 2 * kWeightBits));
}

[[gnu::always_inline]] inline Samples<Layout::One16> sample16(const Tables<Layout::One16>& tables,
                                                              uint8x16_t index, Weights u,
                                                              Weights v) {
  const auto low = [](uint8x16_t a, uint8x16_t b) {
    return vmull_u8(vget_low_u8(a), vget_low_u8(b));
  };
  const auto high = [](uint8x16_t a, uint8x16_t b) { return vmull_high_u8(a, b); };
  const auto products = [&](const auto& times) {
    return Products{times(u.first, v.first), times(u.second, v.first), times(u.first, v.second),
                    times(u.second, v.second)};
  };
  const Neighbourhood l(tables.a, index), h(tables.b, index);
  const auto interpolated = [&](const auto& zip, const Products& weights) {
    const auto words = [&](uint8x16_t a, uint8x16_t b) { return vreinterpretq_u16_u8(zip(a, b)); };
    return interpolate(words(l.upper_left, h.upper_left), words(l.upper_right, h.upper_right),
                       words(l.lower_left, h.lower_left), words(l.lower_right, h.lower_right),
                       weights);
  };
  return {interpolated([](uint8x16_t a, uint8x16_t b) { return vzip1q_u8(a, b); }, products(low)),
          interpolated([](uint8x16_t a, uint8x16_t b) { return vzip2q_u8(a, b); }, products(high))};
}

template <Layout layout>
[[gnu::always_inline]] inline Samples<layout> sample(const std::uint8_t* window,
                                                     std::ptrdiff_t stride, Lanes u, Lanes v) {
  const uint8x16_t index = table_index(u, v);
  const Weights along_u = Weights::of<kFractionBits>(u);
  if constexpr (layout == Layout::One16) {
    const uint16x8_t centre = vdupq_n_u16(kRowCentre);
    const auto along_v =
        Weights::of<kRowFractionBits>({vsubq_u16(v.upper, centre), vsubq_u16(v.lower, centre)});
    return sample16(Tables<layout>(window, stride), index, along_u, along_v);
  } else {
    const Tables<layout> tables(window, stride);
    Samples<layout> samples;
    const auto look_up = [&](const uint8x16x4_t& table) __attribute__((always_inline)) {
      return interpolate(Neighbourhood(table, index), along_u, v);
    };
    samples[0] = look_up(tables.a);
    if constexpr ((kRegisters<layout>) > 1) samples[1] = look_up(tables.b);
    if constexpr ((kRegisters<layout>) > 2) samples[2] = look_up(tables.c);
    if constexpr ((kRegisters<layout>) > 3) samples[3] = look_up(tables.d);
    return samples;
  }
}

// ---- Tiles ----

/// Calls `body` with 0 .. n - 1 as constants.
template <int... n, class Body>
[[gnu::always_inline]] inline void unroll(std::integer_sequence<int, n...>, const Body& body) {
  (body(std::integral_constant<int, n>()), ...);
}

/// Fills a tile in rows of `blocks` blocks, or with their means. The walking state is in local
/// variables: g++ would keep members in memory.
template <Layout layout, int blocks, Mean mean = Mean::None>
void fill_rows(const TileJob& job) {
  constexpr bool kInterleaves = mean == Mean::None && (kRegisters<layout>) > 1;
  constexpr LayoutInfo kInfo = info(layout);
  // The assembly that reads windows declares no memory operand: order it after earlier stores.
  asm volatile("" : : : "memory");
  auto u = AxisLanes<blocks>::template make<0, 0>(job.map.lanes);
  auto v = AxisLanes<blocks>::template make<1, kFractionBits - kRowFractionBits>(job.map.lanes);
  Windows<blocks> windows(job.map.windows);
  const std::uint8_t* const source = job.source.data;
  const std::ptrdiff_t stride = job.source.stride, out_stride = job.target.stride;
  const auto narrow_stride = static_cast<std::int32_t>(stride);
  std::uint8_t* out = job.target.data;
  for (int row = job.map.blocks_y; row > 0; --row) {
    std::array<Samples<layout>, blocks> samples;
    unroll(
        std::make_integer_sequence<int, blocks>(), [&](auto n) __attribute__((always_inline)) {
          constexpr bool kIsLast = n == blocks - 1;
          const uint16x8_t place = windows.place();
          const std::uint8_t* const window =
              windows.template window<kInfo.pixel_bytes>(source, narrow_stride);
          samples[n] = sample<layout>(window, stride, u.current() + vdupq_laneq_u16(place, 0),
                                      v.current() + vdupq_laneq_u16(place, 4));
          if constexpr (kInterleaves) {
            store_block<layout, kIsLast>(samples[n], out + n * kBlock * kInfo.out_bytes(),
                                         out_stride);
          }
          if constexpr (!kIsLast) {
            windows.next_block();
            u.next_block();
            v.next_block();
          }
        });
    if constexpr (mean != Mean::None) {
      store_means<mean>(samples, out, out_stride);
    } else if constexpr (!kInterleaves) {
      store_blocks(samples, out, out_stride);
    }
    out += rows_left(mean) * out_stride;
    windows.next_row();
    u.next_row();
    v.next_row();
  }
}

template <Layout layout>
void fill_tile(const TileJob& job) {
  if (job.map.blocks_x == 4) return fill_rows<layout, 4>(job);
  if (job.map.blocks_x == 1) return fill_rows<layout, 1>(job);
  fill_rows<layout, 2>(job);
}

template <Mean mean>
constexpr auto kMeans = by_layout<kKernelLayouts>([]<Layout layout>() -> Kernel::Tile {
  if constexpr (info(layout).sample_bytes == 1) return fill_rows<layout, 4, mean>;
  return nullptr;
});

using PointLanes [[gnu::vector_size(16)]] = std::uint32_t;

}  // namespace

extern const Kernel kKernel;
constexpr Kernel kKernel{
    .name = "neon",
    .tiles = by_layout<kKernelLayouts>(
        []<Layout layout>() -> Kernel::Tile { return fill_tile<layout>; }),
    .locate = walk_places<PointLanes>,
    .points = kPointWalks,
    .mix = mix_tiles,
    .mix_planes = mix_planes,
    .mix_yuv420 = mix_yuv420_tiles,
    .look_up = look_up_colours,
    .look_up_planes = look_up_planes,
    .look_up_yuv420 = look_up_yuv420,
    .find_entries = find_table_entries,
    .means_along_x = kMeans<Mean::AlongX>,
    .means_along_y = kMeans<Mean::AlongY>,
    .means_of_four = kMeans<Mean::OfFour>,
};

}  // namespace orbwatch::remap::neon
