// SPDX-License-Identifier: Apache-2.0
// The kernel for AVX-512 with VBMI. One register holds a block's 16 pixels, 32 bit each, pixel (i,
// j) in lane 4 j + i: first its coordinate (u in the lower half, v in the upper), then the window's
// four bytes that it lies between, then the sample. A window of one channel fits one register, so
// one vpermb fetches everything that is interpolated. Gather is not used: mitigations make it slow.
//
// The arithmetic is the scalar kernel's, with negative weights, because a unit weight of 128 fits a
// signed byte only that way: -top = a (w - 128) + b (-w) is at most 255 * 128 in size, and
//   X = -top (f - 2048) + -bottom (-f) = 2048 top + (bottom - top) f,  f: v's fraction, Q11.
// The scalar kernel has v = 32 f - 2^15; its sum top + bottom + (((bottom - top) v + 2^14) >> 15)
// is (X + 2^9) >> 10, and shifting down in two steps is the same as in one: its result is (X + 2^9
// + 2^17) >> 18. A 16 bit sample is interpolated as two bytes, whose exact sums are added before
// they are rounded.

#include <immintrin.h>

#include <array>
#include <bit>
#include <cstddef>
#include <cstring>
#include <utility>

#include "proc/remap/kernel/bilinear.h"
#include "proc/remap/kernel/look_up_avx512.h"
#include "proc/remap/kernel/mix_avx512.h"
#include "proc/remap/kernel/point_walk.h"
#include "proc/remap/kernel/yuv420_mix.h"
#include "proc/remap/kernel/yuv_avx512.h"

namespace orbwatch::remap::avx512 {
namespace {

constexpr int kMostBlocks = kTile / kBlock, kMostRows = 2 * kMostBlocks;

/// Initial values of a register's lanes, computed at compile time.
template <class T>
struct alignas(64) Lanes {
  T at[64 / sizeof(T)];

  template <class Value>
  static constexpr Lanes of(const Value& value) {
    Lanes lanes{};
    for (int k = 0; k < static_cast<int>(64 / sizeof(T)); ++k) {
      lanes.at[k] = static_cast<T>(value(k));
    }
    return lanes;
  }
  __m512i load() const { return _mm512_load_si512(at); }
};
using Bytes = Lanes<std::uint8_t>;
using Words = Lanes<std::uint16_t>;
using Doublewords = Lanes<std::uint32_t>;

/// Sets every lane to `value`.
template <std::uint32_t value>
__m512i each() {
  return _mm512_set1_epi32(static_cast<std::int32_t>(value));
}

constexpr int column(int word) { return word / 2 % kBlock; }
constexpr int line(int word) { return word / 2 / kBlock; }

/// Positions of the blocks of one row. Written as vectors, read block by block.
struct alignas(64) BlockRow {
  AxisPair<std::int64_t> windows[kMostBlocks];  ///< Q32, see WindowWalk
  AxisPair<std::uint16_t> places[kMostBlocks];  ///< fractions of the positions
};

/// Iterates over a tile's windows by rows of blocks, all of a row at once: u and v of each in turn.
class RowWalk {
 public:
  explicit RowWalk(const WindowWalk& walk) {
    // Masks of blocks 1 and 3; 2 and 3; 3.
    constexpr __mmask8 kOdd = 0xcc, kUpper = 0xf0, kLast = 0xc0;
    const auto times_x = [](__m512i start, __m512i step) {
      const __m512i one = _mm512_mask_add_epi64(start, kOdd, start, step);
      return _mm512_mask_add_epi64(one, kUpper, one, _mm512_add_epi64(step, step));
    };
    const __m512i xx = both(walk.xx);
    __m512i values = times_x(both(walk.value), both(walk.step_x));
    values = _mm512_mask_add_epi64(values, kUpper, values, xx);
    values_ = _mm512_mask_add_epi64(values, kLast, values, _mm512_add_epi64(xx, xx));
    steps_ = times_x(both(walk.step_y), both(walk.xy));
    growth_ = both(walk.yy);
  }

  void write(BlockRow& row) const {
    static constexpr auto kShifts =
        Doublewords::of([](int k) { return 32 - (k % 4 == 0 ? kFractionBits : kRowFractionBits); });
    static constexpr auto kFractions = Words::of([](int k) { return k * 4; });
    const __m512i fractions =
        _mm512_permutexvar_epi16(kFractions.load(), _mm512_srlv_epi32(values_, kShifts.load()));
    _mm512_store_si512(row.windows, values_);
    _mm_store_si128(reinterpret_cast<__m128i*>(row.places), _mm512_castsi512_si128(fractions));
  }
  void next() {
    values_ = _mm512_add_epi64(values_, steps_);
    steps_ = _mm512_add_epi64(steps_, growth_);
  }

 private:
  static __m512i both(const Uv64& pair) {
    return _mm512_broadcast_i32x4(_mm_loadu_si128(reinterpret_cast<const __m128i*>(&pair)));
  }

  __m512i values_;
  __m512i steps_;
  __m512i growth_;
};

/// The lanes of block (0, 0) without its place, and their steps from block to block. Lanes of v
/// count from the window on, without kRowCentre.
struct Shape {
  __m512i start, along_x, along_y;

  explicit Shape(const LaneShape& shape) {
    static constexpr auto kI = Words::of(column);
    static constexpr auto kJ = Words::of(line);
    const auto each = [](const auto& pair) {
      return _mm512_set1_epi32(std::bit_cast<std::int32_t>(pair));
    };
    const __m512i i = kI.load(), j = kJ.load();
    const auto weighed = [i, j](__m512i a, __m512i b) {
      return _mm512_add_epi16(_mm512_mullo_epi16(i, a), _mm512_mullo_epi16(j, b));
    };
    const auto eighth = [](__m512i value) {
      return _mm512_srai_epi16(_mm512_add_epi16(value, _mm512_set1_epi16(4)), 3);
    };
    const __m512i xy = each(shape.xy);
    const __m512i x = eighth(weighed(each(shape.twice_xx), xy));
    const __m512i y = eighth(weighed(xy, each(shape.twice_yy)));
    const __m512i slope = weighed(each(shape.slope_x), each(shape.slope_y));
    const __m512i pixels =
        _mm512_add_epi16(_mm512_add_epi16(slope, eighth(weighed(x, y))), each(shape.offset));

    // Lanes of v are rounded to rows.
    constexpr __mmask32 kV = 0xaaaaaaaa;
    constexpr int kShift = kFractionBits - kRowFractionBits;
    const __m512i half = _mm512_set1_epi16(1 << (kShift - 1));
    const auto steps = [half](__m512i lanes) {
      return _mm512_mask_srai_epi16(lanes, kV, _mm512_add_epi16(lanes, half), kShift);
    };
    along_x = steps(x);
    along_y = steps(y);
    start = _mm512_mask_srli_epi16(pixels, kV, _mm512_add_epi16(pixels, half), kShift);
    start = _mm512_sub_epi16(start, _mm512_set1_epi32(kRowCentre << 16));
  }
};

/// Positions and weights for the interpolation of a block's pixels: each pixel has 4 bytes, or two
/// times 16 bit, of each.
struct Places {
  __m512i index;   ///< indices of the four neighbours in a channel of the window
  __m512i across;  ///< weights w - 128, -w along u, for the upper and for the lower neighbours
  __m512i down;    ///< weights of the upper and of the lower neighbours along v, negative too

  template <int down_bits>
  static Places of(__m512i lanes);
};

/// Bit of a pair of lanes: bit `first` of the lane that contains byte `byte`.
constexpr int bit(int byte, int first) { return byte / 4 % 2 * 32 + first; }

/// A mask with bits [first, end) set.
constexpr std::uint32_t bits_from(int first, int end) { return (1U << end) - (1U << first); }

template <int down_bits>
Places Places::of(__m512i lanes) {
  // vpmultishiftqb selects any 8 bits of 64 for each byte; v is 16 bits above u.
  constexpr int kU = kFractionBits, kV = 16 + kRowFractionBits;
  static constexpr auto kWholeU = Bytes::of([](int k) { return bit(k, kU); });
  static constexpr auto kWholeV = Bytes::of([](int k) { return bit(k, kV - 3); });
  static constexpr auto kAcross = Bytes::of([](int k) { return bit(k, kU - kWeightBits); });
  static constexpr auto kDown = Bytes::of([](int k) { return bit(k, kV - down_bits + k % 2 * 8); });
  const auto bits = [lanes](const Bytes& first) {
    return _mm512_multishift_epi64_epi8(first.load(), lanes);
  };

  // Index 8 v + u, of which vpermb uses the lower 6 bits.
  constexpr int kSelect = 0xca;
  const __m512i corner =
      _mm512_ternarylogic_epi32(each<0x07070707>(), bits(kWholeU), bits(kWholeV), kSelect);
  Places places;
  places.index = _mm512_add_epi8(corner, each<0x09080100>());

  // A fraction with all higher bits set is the fraction less one; with the fraction's bits flipped
  // beforehand, and 1 added, it is the negative fraction.
  constexpr int kFlipOr = 0xbe;
  const __m512i across = _mm512_ternarylogic_epi32(
      bits(kAcross), each<0xff00ff00>(), each<0x01010101 * bits_from(kWeightBits, 8)>(), kFlipOr);
  places.across = _mm512_add_epi8(across, each<0x01000100>());
  const __m512i down = _mm512_ternarylogic_epi32(
      bits(kDown), each<0xffff0000>(), each<0x00010001 * bits_from(down_bits, 16)>(), kFlipOr);
  places.down = _mm512_add_epi16(down, each<0x00010000>());
  return places;
}

/// A block's window: the rows one after another in as many registers as they need.
template <int pixel_bytes>
struct Window {
  static constexpr int kRegisters = std::bit_ceil(static_cast<unsigned>(pixel_bytes));
  static constexpr int kRows = kWindow / kRegisters;

  Window(const std::uint8_t* from, std::ptrdiff_t stride) {
#pragma GCC unroll 4
    for (int k = 0; k < kRegisters; ++k) registers[k] = rows(from + k * kRows * stride, stride);
  }

  static __m512i rows(const std::uint8_t* from, std::ptrdiff_t stride) {
    const auto load = [=](int row) {
      return _mm_loadu_si128(reinterpret_cast<const __m128i*>(from + row * stride));
    };
    if constexpr (pixel_bytes == 1) {
      __m512i all = _mm512_broadcastq_epi64(_mm_loadu_si64(from));
#pragma GCC unroll 8
      for (int row = 1; row < kRows; ++row) {
        all = _mm512_mask_broadcastq_epi64(all, static_cast<__mmask8>(1 << row),
                                           _mm_loadu_si64(from + row * stride));
      }
      return all;
    } else if constexpr (pixel_bytes == 2) {
      __m512i all = _mm512_broadcast_i32x4(load(0));
#pragma GCC unroll 4
      for (int row = 1; row < kRows; ++row) {
        all = _mm512_mask_broadcast_i32x4(all, static_cast<__mmask16>(0xf << 4 * row), load(row));
      }
      return all;
    } else {
      // Reads 24 bytes of a row of three byte pixels: memory beyond may not be readable.
      constexpr __mmask8 kRow = pixel_bytes == 3 ? 7 : 15;
      const __m256i upper = _mm256_maskz_loadu_epi64(kRow, from);
      const __m256i lower = _mm256_maskz_loadu_epi64(kRow, from + stride);
      return _mm512_inserti64x4(_mm512_castsi256_si512(upper), lower, 1);
    }
  }

  __m512i registers[kRegisters];
};

/// The samples of one channel of a window, 8 rows of 8 bytes. They begin at byte `first` of a
/// pixel.
template <int pixel_bytes, int first>
__m512i channel(const Window<pixel_bytes>& window) {
  using From = Window<pixel_bytes>;
  if constexpr (pixel_bytes == 1) return window.registers[0];
  static constexpr auto kIndex = Bytes::of([](int k) {
    return k / kWindow % From::kRows * (64 / From::kRows) + k % kWindow * pixel_bytes + first;
  });
  __m512i samples = _mm512_permutexvar_epi8(kIndex.load(), window.registers[0]);
#pragma GCC unroll 4
  for (int k = 1; k < From::kRegisters; ++k) {
    constexpr std::uint64_t kBytes = ~std::uint64_t{0} >> (64 - 64 / From::kRegisters);
    samples = _mm512_mask_permutexvar_epi8(samples, kBytes << (64 / From::kRegisters * k),
                                           kIndex.load(), window.registers[k]);
  }
  return samples;
}

/// One byte of each pixel's neighbours, times the unit weights of u and v.
__m512i weighed(__m512i neighbours, const Places& places) {
  return _mm512_madd_epi16(_mm512_maddubs_epi16(neighbours, places.across), places.down);
}

/// Pixels of two blocks at half steps along an axis that make one block: the even columns, or the
/// even rows. The second half comes from the second block; kSecond is the mask of its bytes.
enum class Kept { All, EvenColumns, EvenRows };

template <Kept kept>
__m512i merged_lanes(__m512i first, __m512i second) {
  static constexpr auto kOrder = Doublewords::of([](int k) {
    const int i = k % kBlock, j = k / kBlock;
    const int along = 2 * (kept == Kept::EvenColumns ? i : j);
    const int lane =
        kept == Kept::EvenColumns ? kBlock * j + along % kBlock : kBlock * (along % kBlock) + i;
    return along >= kBlock ? 16 + lane : lane;
  });
  return _mm512_permutex2var_epi32(first, kOrder.load(), second);
}
template <Kept kept>
constexpr __mmask64 kSecond = kept == Kept::EvenColumns ? 0xff00ff00ff00ff00 : 0xffffffff00000000;

/// The block's pixels, each from the lowest byte of its lane on; for two blocks, each with a window
/// of its own, those that are kept. Inlined, so that values shared by all blocks stay in registers.
template <Layout layout, Kept kept>
[[gnu::always_inline]] inline __m512i sample(const std::uint8_t* from, const std::uint8_t* beside,
                                             std::ptrdiff_t stride, __m512i lanes) {
  constexpr LayoutInfo kInfo = info(layout);
  constexpr int kDownBits = kInfo.sample_bytes == 2 ? kWeightBits : kRowFractionBits;
  constexpr int kShift = kWeightBits + kDownBits;
  const Window<kInfo.pixel_bytes> window(from, stride);
  const Places places = Places::of<kDownBits>(lanes);
  const auto sum = [&]<int byte>() {
    __m512i neighbours =
        _mm512_permutexvar_epi8(places.index, channel<kInfo.pixel_bytes, byte>(window));
    if constexpr (kept != Kept::All) {
      const Window<kInfo.pixel_bytes> other(beside, stride);
      neighbours = _mm512_mask_permutexvar_epi8(neighbours, kSecond<kept>, places.index,
                                                channel<kInfo.pixel_bytes, byte>(other));
    }
    return weighed(neighbours, places);
  };
  if constexpr (kInfo.sample_bytes == 2) {
    const __m512i both = _mm512_add_epi32(sum.template operator()<0>(),
                                          _mm512_slli_epi32(sum.template operator()<1>(), 8));
    return _mm512_srli_epi32(_mm512_add_epi32(both, each<1 << (kShift - 1)>()), kShift);
  } else {
    const __m512i round = each<(1 << (kShift - 1)) + (1 << (kDownBits - 2))>();
    const auto rounded = [&]<int k>() {
      return _mm512_add_epi32(sum.template operator()<kInfo.first + k * kInfo.every>(), round);
    };
    constexpr int kOrAnd = 0xf8;  // computes a | (b & c)
    __m512i pixels = _mm512_srli_epi32(rounded.template operator()<0>(), kShift);
    if constexpr (kInfo.samples > 1) {
      const __m512i second = _mm512_srli_epi32(rounded.template operator()<1>(), kShift - 8);
      pixels = _mm512_ternarylogic_epi32(pixels, second, each<0xff00>(), kOrAnd);
    }
    if constexpr (kInfo.samples > 2) {
      const __m512i third = _mm512_srli_epi32(rounded.template operator()<2>(), kShift - 16);
      pixels = _mm512_ternarylogic_epi32(pixels, third, each<0xff0000>(), kOrAnd);
    }
    if constexpr (kInfo.samples > 3) {
      const __m512i fourth = _mm512_slli_epi32(rounded.template operator()<3>(), 24 - kShift);
      pixels = _mm512_ternarylogic_epi32(pixels, fourth, each<0xff000000>(), kOrAnd);
    }
    return pixels;
  }
}

/// Number of adjacent blocks that make rows of 16 bytes, or of 48 if a pixel has three.
constexpr int group_of(int out_bytes) { return out_bytes == 3 ? 4 : 4 / out_bytes; }

/// A group's rows in parts of 16 bytes: row j of each part is in 128 bit lane j.
template <int out_bytes>
struct Rows {
  __m512i parts[out_bytes == 3 ? 3 : 1];
};

template <int out_bytes>
Rows<out_bytes> rows_of(const __m512i (&blocks)[group_of(out_bytes)]) {
  if constexpr (out_bytes == 1) {
    return {{_mm512_packus_epi16(_mm512_packus_epi32(blocks[0], blocks[1]),
                                 _mm512_packus_epi32(blocks[2], blocks[3]))}};
  } else if constexpr (out_bytes == 2) {
    return {{_mm512_packus_epi32(blocks[0], blocks[1])}};
  } else if constexpr (out_bytes == 3) {
    const __m512i order = _mm512_broadcast_i32x4(
        _mm_setr_epi8(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, -1, -1, -1, -1));
    const auto row = [&](int k) { return _mm512_shuffle_epi8(blocks[k], order); };
    const __m512i second = row(1), third = row(2);
    return {{_mm512_or_si512(row(0), _mm512_bslli_epi128(second, 12)),
             _mm512_or_si512(_mm512_bsrli_epi128(second, 4), _mm512_bslli_epi128(third, 8)),
             _mm512_or_si512(_mm512_bsrli_epi128(third, 8), _mm512_bslli_epi128(row(3), 4))}};
  } else {
    return {{blocks[0]}};
  }
}

/// Stores the first `bytes` of row j of `parts`, a multiple of 4.
template <int j, int bytes>
void store_row(const __m512i* parts, std::uint8_t* out) {
  const __m128i row = _mm512_extracti32x4_epi32(parts[0], j);
  if constexpr (bytes >= 16) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out), row);
    if constexpr (bytes > 16) store_row<j, bytes - 16>(parts + 1, out + 16);
  } else {
    // Masked stores are avoided: some processors need many cycles for one.
    if constexpr (bytes >= 8) _mm_storeu_si64(out, row);
    constexpr int kLast = bytes / 4 - 1;
    const int last = _mm_extract_epi32(row, kLast);
    if constexpr (bytes % 8 != 0) std::memcpy(out + 4 * kLast, &last, sizeof last);
  }
}

/// Address of a block's window in the source.
template <Layout layout>
[[gnu::always_inline]] inline const std::uint8_t* window_of(const TileJob& job, const BlockRow& row,
                                                            int x) {
  const AxisPair<std::int64_t>& window = row.windows[x];
  return job.source.data + (window.v >> 32) * job.source.stride +
         (window.u >> 32) * info(layout).pixel_bytes;
}
[[gnu::always_inline]] inline __m512i place_of(const BlockRow& row, int x) {
  std::int32_t place = 0;
  std::memcpy(&place, &row.places[x], sizeof(place));
  return _mm512_set1_epi32(place);
}

/// Fills one row of blocks; block (0, y) has `shape.start`. If `kept` is not All, fills the kept
/// pixels of a row of pairs of blocks: two side by side, or this row's and the next one's.
template <Layout layout, int blocks_x, Kept kept>
void fill_row(const TileJob& job, const BlockRow* row, const Shape& shape, std::uint8_t* out) {
  constexpr int kOutBytes = info(layout).out_bytes(), kStep = kept == Kept::EvenColumns ? 2 : 1;
  constexpr int kGroup = group_of(kOutBytes), kMade = blocks_x / kStep;
  constexpr int kCount = kGroup < kMade ? kGroup : kMade;
  __m512i lanes = shape.start;
#pragma GCC unroll 1
  for (int x = 0; x < kMade; x += kCount) {
    __m512i blocks[kGroup]{};
#pragma GCC unroll 4
    for (int k = 0; k < kCount; ++k) {
      const int block = kStep * (x + k);
      const std::uint8_t* const window = window_of<layout>(job, row[0], block);
      __m512i here = _mm512_add_epi16(lanes, place_of(row[0], block));
      const std::uint8_t* second = nullptr;
      if constexpr (kept == Kept::EvenColumns) {
        lanes = _mm512_add_epi16(lanes, shape.along_x);
        second = window_of<layout>(job, row[0], block + 1);
        here = merged_lanes<kept>(here, _mm512_add_epi16(lanes, place_of(row[0], block + 1)));
      } else if constexpr (kept == Kept::EvenRows) {
        const __m512i below = _mm512_add_epi16(lanes, shape.along_y);
        second = window_of<layout>(job, row[1], block);
        here = merged_lanes<kept>(here, _mm512_add_epi16(below, place_of(row[1], block)));
      }
      blocks[k] = sample<layout, kept>(window, second, job.source.stride, here);
      lanes = _mm512_add_epi16(lanes, shape.along_x);
    }
    const auto rows = rows_of<kOutBytes>(blocks);
    constexpr int kBytes = kCount * kBlock * kOutBytes;
    store_row<0, kBytes>(rows.parts, out);
    store_row<1, kBytes>(rows.parts, out + job.target.stride);
    store_row<2, kBytes>(rows.parts, out + 2 * job.target.stride);
    store_row<3, kBytes>(rows.parts, out + 3 * job.target.stride);
    out += kBytes;
  }
}

template <Layout layout, int blocks_x, Kept kept>
void fill_rows(const TileJob& job) {
  // All rows are walked first: else the compiler extracts places from the vectors on the port that
  // vpermb needs.
  BlockRow rows[kMostRows];
  RowWalk walk(job.map.windows);
  const int blocks_y = job.map.blocks_y;
  for (int y = 0; y < blocks_y; ++y) {
    walk.write(rows[y]);
    walk.next();
  }
  Shape shape(job.map.lanes);
  std::uint8_t* out = job.target.data;
  constexpr int kStep = kept == Kept::EvenRows ? 2 : 1;
  for (int y = 0; y < blocks_y; y += kStep) {
    fill_row<layout, blocks_x, kept>(job, &rows[y], shape, out);
    for (int n = 0; n < kStep; ++n) shape.start = _mm512_add_epi16(shape.start, shape.along_y);
    out += kBlock * job.target.stride;
  }
}

template <Layout layout, Kept kept = Kept::All>
void fill_tile(const TileJob& job) {
  if (job.map.blocks_x == kMostBlocks) return fill_rows<layout, kMostBlocks, kept>(job);
  if constexpr (kept == Kept::All) {
    if (job.map.blocks_x == 1) return fill_rows<layout, 1, kept>(job);
  }
  fill_rows<layout, kMostBlocks / 2, kept>(job);
}

template <Kept kept>
constexpr auto kTiles = by_layout<kKernelLayouts>([]<Layout layout>() -> Kernel::Tile {
  return fill_tile<layout, kept>;
});

using PointLanes [[gnu::vector_size(64)]] = std::uint32_t;

}  // namespace

extern const Kernel kKernel;
constexpr Kernel kKernel{
    .name = "avx512",
    .tiles = kTiles<Kept::All>,
    .locate = walk_places<PointLanes>,
    .points = kPointWalks,
    .mix = mix_tiles,
    .mix_yuv420 = mix_yuv420_tiles,
    .look_up = look_up_colours,
    .look_up_yuv420 = look_up_yuv420,
    .find_entries = find_entries,
    .write_rgb = write_rgb,
    .even_columns = kTiles<Kept::EvenColumns>,
    .even_rows = kTiles<Kept::EvenRows>,
    .fetches_ahead = true,
};

}  // namespace orbwatch::remap::avx512
