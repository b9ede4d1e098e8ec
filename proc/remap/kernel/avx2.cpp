// SPDX-License-Identifier: Apache-2.0
// The kernel for AVX2. One register holds 16 bit for each of a block's 16 pixels, row by row. A
// channel's window of 8 rows of 8 bytes is four tables for vpshufb, two rows each, in both halves
// of a register. Gather is not used: mitigations make it slow.
//
// The arithmetic is the scalar kernel's, with negative weights, because a unit weight of 128 fits a
// signed byte only that way: a (w - 128) + b (-w) = -top, at most 255 * 128 in size. A 16 bit
// sample is interpolated as two bytes, whose exact sums are added before they are rounded.

#include <immintrin.h>

#include <algorithm>
#include <cstddef>
#include <cstring>

#include "proc/remap/kernel/bilinear.h"
#include "proc/remap/kernel/find_entries_avx2.h"
#include "proc/remap/kernel/look_up.h"
#include "proc/remap/kernel/mix_avx2.h"
#include "proc/remap/kernel/point_walk.h"
#include "proc/remap/kernel/windows_avx2.h"
#include "proc/remap/kernel/yuv420_mix.h"
#include "proc/remap/kernel/yuv_avx2.h"

namespace orbwatch::remap::avx2 {
namespace {

constexpr int kMostBlocks = kTile / kBlock, kMostRows = 2 * kMostBlocks;

/// Positions of the blocks of one row. Written as vectors, read block by block.
struct alignas(32) BlockRow {
  AxisPair<std::int64_t> windows[kMostBlocks];  ///< Q32, see WindowWalk
  /// Fractions of the positions, twice in 32 bits; the other 32 are not used.
  AxisPair<std::int64_t> places[kMostBlocks];
};

/// Writes the rows of blocks of a tile.
void walk(const BlockMap& map, BlockRow* rows) {
  const auto both = [](const Uv64& pair) { return _mm256_broadcastsi128_si256(load128(&pair)); };
  const auto twice = [](__m256i value) { return _mm256_add_epi64(value, value); };
  // Block x is in the lower half and block x + 1 in the upper.
  const auto upper = [](__m256i value) {
    return _mm256_blend_epi32(_mm256_setzero_si256(), value, 0xf0);
  };
  const WindowWalk& w = map.windows;
  const __m256i step_x = both(w.step_x), xx = both(w.xx), xy = both(w.xy), yy = both(w.yy);
  // Positions of blocks 0 and 1, and of 2 and 3: x step_x + x (x - 1) / 2 xx.
  __m256i left = _mm256_add_epi64(both(w.value), upper(step_x));
  __m256i right = _mm256_add_epi64(_mm256_add_epi64(left, twice(step_x)),
                                   _mm256_add_epi64(xx, upper(twice(xx))));
  __m256i left_step = _mm256_add_epi64(both(w.step_y), upper(xy));
  __m256i right_step = _mm256_add_epi64(left_step, twice(xy));

  const __m256i shifts = _mm256_setr_epi32(32 - kFractionBits, 0, 32 - kRowFractionBits, 0,
                                           32 - kFractionBits, 0, 32 - kRowFractionBits, 0);
  const __m256i doubled = _mm256_broadcastsi128_si256(
      _mm_setr_epi8(0, 1, 0, 1, -1, -1, -1, -1, 8, 9, 8, 9, -1, -1, -1, -1));
  const auto write = [&](__m256i values, BlockRow& row, int x) {
    _mm256_store_si256(reinterpret_cast<__m256i*>(&row.windows[x]), values);
    _mm256_store_si256(reinterpret_cast<__m256i*>(&row.places[x]),
                       _mm256_shuffle_epi8(_mm256_srlv_epi32(values, shifts), doubled));
  };
  for (int y = 0; y < map.blocks_y; ++y) {
    write(left, rows[y], 0);
    write(right, rows[y], 2);
    left = _mm256_add_epi64(left, left_step);
    right = _mm256_add_epi64(right, right_step);
    left_step = _mm256_add_epi64(left_step, yy);
    right_step = _mm256_add_epi64(right_step, yy);
  }
}

/// Pixels of a block that are made: all, or those in even columns or rows of two blocks, each of
/// which fills one half of a register.
enum class Kept { All, EvenColumns, EvenRows };

/// One axis: the lanes of block (0, 0) without its place, and their steps from block to block.
struct Shape {
  using Axis = std::int16_t AxisPair<std::int16_t>::*;
  __m256i start, along_x, along_y;

  Shape(const LaneShape& shape, Axis axis, std::uint16_t offset, Kept kept) {
    const __m256i all = _mm256_set1_epi64x(0x0003000200010000);
    const __m256i even = _mm256_set1_epi32(0x00020000);
    const __m256i i = kept == Kept::EvenColumns ? even : all;
    const __m256i j = kept == Kept::All
                          ? _mm256_setr_epi16(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3)
                      : kept == Kept::EvenColumns
                          ? _mm256_setr_epi16(0, 0, 1, 1, 2, 2, 3, 3, 0, 0, 1, 1, 2, 2, 3, 3)
                          : _mm256_setr_epi16(0, 0, 0, 0, 2, 2, 2, 2, 0, 0, 0, 0, 2, 2, 2, 2);
    const auto sum = [i, j](__m256i a, __m256i b) {
      return _mm256_add_epi16(_mm256_mullo_epi16(i, a), _mm256_mullo_epi16(j, b));
    };
    const auto eighth = [](__m256i value) {
      return _mm256_srai_epi16(_mm256_add_epi16(value, each(4)), 3);
    };
    const __m256i xy = each(shape.xy.*axis);
    along_x = eighth(sum(each(shape.twice_xx.*axis), xy));
    along_y = eighth(sum(xy, each(shape.twice_yy.*axis)));
    start = _mm256_add_epi16(sum(each(shape.slope_x.*axis), each(shape.slope_y.*axis)),
                             _mm256_add_epi16(eighth(sum(along_x, along_y)), each(offset)));
  }

  /// Rounds lanes to those of v, but counted from the window on, without kRowCentre.
  void round_to_rows() {
    constexpr int kShift = kFractionBits - kRowFractionBits;
    const __m256i half = each(1 << (kShift - 1));
    start = _mm256_sub_epi16(_mm256_srli_epi16(_mm256_add_epi16(start, half), kShift),
                             each(kRowCentre));
    along_x = _mm256_srai_epi16(_mm256_add_epi16(along_x, half), kShift);
    along_y = _mm256_srai_epi16(_mm256_add_epi16(along_y, half), kShift);
  }

  /// Moves the upper half to the second block of a pair, and doubles the step between pairs.
  void step_by_pairs(Kept kept) {
    if (kept == Kept::All) return;
    __m256i& step = kept == Kept::EvenColumns ? along_x : along_y;
    start = _mm256_add_epi16(start, _mm256_blend_epi32(_mm256_setzero_si256(), step, 0xf0));
    step = _mm256_add_epi16(step, step);
  }
};

/// 8 bit samples from one channel.
__m256i sample8(const Rows& rows, __m256i v) {
  // The higher bits are removed and 1/2 subtracted, like in the scalar kernel.
  const __m256i weight =
      _mm256_xor_si256(_mm256_slli_epi16(v, 16 - kRowFractionBits), each(-0x8000));
  const __m256i change = _mm256_mulhrs_epi16(_mm256_sub_epi16(rows.top, rows.bottom), weight);
  const __m256i twice = _mm256_sub_epi16(change, _mm256_add_epi16(rows.top, rows.bottom));
  return _mm256_srli_epi16(_mm256_add_epi16(twice, each(kUnitWeight)), kWeightBits + 1);
}

/// 16 bit samples from the channels of their lower and upper bytes.
__m256i sample16(const Rows& low, const Rows& high, __m256i v) {
  const __m256i w =
      _mm256_and_si256(_mm256_srli_epi16(v, kRowFractionBits - kWeightBits), each(kUnitWeight - 1));
  const __m256i top = _mm256_sub_epi16(w, each(kUnitWeight));
  const __m256i bottom = _mm256_sub_epi16(_mm256_setzero_si256(), w);
  const auto rounded = [](__m256i low_sum, __m256i high_sum) {
    constexpr int kShift = 2 * kWeightBits;
    const __m256i sum = _mm256_add_epi32(low_sum, _mm256_slli_epi32(high_sum, 8));
    return _mm256_srli_epi32(_mm256_add_epi32(sum, _mm256_set1_epi32(1 << (kShift - 1))), kShift);
  };
  const __m256i weights02 = _mm256_unpacklo_epi16(top, bottom);
  const __m256i weights13 = _mm256_unpackhi_epi16(top, bottom);
  const auto sum02 = [&](const Rows& rows) {
    return _mm256_madd_epi16(_mm256_unpacklo_epi16(rows.top, rows.bottom), weights02);
  };
  const auto sum13 = [&](const Rows& rows) {
    return _mm256_madd_epi16(_mm256_unpackhi_epi16(rows.top, rows.bottom), weights13);
  };
  return _mm256_packus_epi32(rounded(sum02(low), sum02(high)), rounded(sum13(low), sum13(high)));
}

/// The block's pixels: up to 16 bit of each in `first`, further bits in `more`.
struct Pixels {
  __m256i first, more;
};

/// Samples a window of rows that are `stride` apart, or two.
template <Layout layout, Kept kept, WindowPart part>
[[gnu::always_inline]] inline Pixels sample(const std::uint8_t* from, const std::uint8_t* beside,
                                            std::ptrdiff_t stride, const Places& places) {
  constexpr int kSamples = info(layout).samples;
  Rows rows[info(layout).out_bytes()];
  interpolate_rows<layout, kept != Kept::All, part>(from, beside, stride, places, rows);
  if constexpr (info(layout).sample_bytes == 2) {
    return {sample16(rows[0], rows[1], places.v), _mm256_setzero_si256()};
  } else {
    const auto channel = [&](int k) { return sample8(rows[k], places.v); };
    const auto pair = [&](int k) {
      return _mm256_or_si256(channel(k), _mm256_slli_epi16(channel(k + 1), 8));
    };
    if constexpr (kSamples == 1) return {channel(0), _mm256_setzero_si256()};
    if constexpr (kSamples == 2) return {pair(0), _mm256_setzero_si256()};
    if constexpr (kSamples == 3) return {pair(0), channel(2)};
    if constexpr (kSamples == 4) return {pair(0), pair(2)};
  }
}

/// Number of adjacent blocks whose rows are stored together.
constexpr int group_of(int out_bytes) { return out_bytes == 4 ? 1 : out_bytes == 2 ? 2 : 4; }

/// The rows of a group of blocks, 0 and 2, 1 and 3, in parts of 16 bytes.
template <int out_bytes>
struct GroupRows {
  static constexpr int kParts = out_bytes == 3 ? 3 : 1;
  __m256i even[kParts], odd[kParts];
};

/// Joins pixels of four bytes, the last one unused, of four blocks.
inline void join_threes(const __m256i (&blocks)[4], __m256i (&parts)[3]) {
  const auto moved = [&](int k, __m128i order) {
    return _mm256_shuffle_epi8(blocks[k], _mm256_broadcastsi128_si256(order));
  };
  constexpr char no = -1;
  parts[0] = _mm256_or_si256(
      moved(0, _mm_setr_epi8(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, no, no, no, no)),
      moved(1, _mm_setr_epi8(no, no, no, no, no, no, no, no, no, no, no, no, 0, 1, 2, 4)));
  parts[1] = _mm256_or_si256(
      moved(1, _mm_setr_epi8(5, 6, 8, 9, 10, 12, 13, 14, no, no, no, no, no, no, no, no)),
      moved(2, _mm_setr_epi8(no, no, no, no, no, no, no, no, 0, 1, 2, 4, 5, 6, 8, 9)));
  parts[2] = _mm256_or_si256(
      moved(2, _mm_setr_epi8(10, 12, 13, 14, no, no, no, no, no, no, no, no, no, no, no, no)),
      moved(3, _mm_setr_epi8(no, no, no, no, 0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14)));
}

template <int out_bytes>
[[gnu::always_inline]] inline GroupRows<out_bytes> rows_of(
    const Pixels (&blocks)[group_of(out_bytes)]) {
  if constexpr (out_bytes == 1) {
    const auto four = [](const Pixels& left, const Pixels& right) {
      return _mm256_castsi256_ps(_mm256_packus_epi16(left.first, right.first));
    };
    const __m256 left = four(blocks[0], blocks[1]), right = four(blocks[2], blocks[3]);
    return {{_mm256_castps_si256(_mm256_shuffle_ps(left, right, 0x88))},
            {_mm256_castps_si256(_mm256_shuffle_ps(left, right, 0xdd))}};
  } else if constexpr (out_bytes == 2) {
    return {{_mm256_unpacklo_epi64(blocks[0].first, blocks[1].first)},
            {_mm256_unpackhi_epi64(blocks[0].first, blocks[1].first)}};
  } else {
    constexpr int kBlocks = group_of(out_bytes);
    __m256i even[kBlocks], odd[kBlocks];
#pragma GCC unroll 4
    for (int k = 0; k < kBlocks; ++k) {
      even[k] = _mm256_unpacklo_epi16(blocks[k].first, blocks[k].more);
      odd[k] = _mm256_unpackhi_epi16(blocks[k].first, blocks[k].more);
    }
    if constexpr (out_bytes == 4) {
      return {{even[0]}, {odd[0]}};
    } else {
      GroupRows<3> rows;
      join_threes(even, rows.even);
      join_threes(odd, rows.odd);
      return rows;
    }
  }
}

template <int bytes>
void store_part(__m128i part, std::uint8_t* out) {
  if constexpr (bytes == 16) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out), part);
  } else if constexpr (bytes == 4) {
    _mm_storeu_si32(out, part);
  } else {
    _mm_storeu_si64(out, part);
    if constexpr (bytes == 12) _mm_storeu_si32(out + 8, _mm_srli_si128(part, 8));
  }
}

/// Stores `bytes` bytes of two rows, in as few stores as possible: many wait until the target's
/// lines are in the cache.
template <int bytes>
[[gnu::always_inline]] inline void store_rows(const __m256i* parts, std::uint8_t* first,
                                              std::uint8_t* second) {
  if constexpr (bytes >= 32) {
    const auto store = [](std::uint8_t* to, __m256i row) {
      _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), row);
    };
    store(first, _mm256_permute2x128_si256(parts[0], parts[1], 0x20));
    store(second, _mm256_permute2x128_si256(parts[0], parts[1], 0x31));
    if constexpr (bytes > 32) store_rows<bytes - 32>(parts + 2, first + 32, second + 32);
  } else {
    constexpr int kHere = std::min(bytes, 16);
    store_part<kHere>(_mm256_castsi256_si128(parts[0]), first);
    store_part<kHere>(_mm256_extracti128_si256(parts[0], 1), second);
    if constexpr (bytes > 16) store_rows<bytes - 16>(parts + 1, first + 16, second + 16);
  }
}

template <Layout layout>
const std::uint8_t* begin(const TileJob& job, const AxisPair<std::int64_t>& window) {
  return job.source.data + (window.v >> 32) * job.source.stride +
         (window.u >> 32) * info(layout).pixel_bytes;
}

/// Block of a row of blocks.
struct BlockAt {
  const BlockRow& row;
  int x;

  template <Layout layout>
  const std::uint8_t* window(const TileJob& job) const {
    return begin<layout>(job, row.windows[x]);
  }
  __m256i place_u() const { return each_place(&row.places[x].u); }
  __m256i place_v() const { return each_place(&row.places[x].v); }

 private:
  static __m256i each_place(const std::int64_t* twice) {
    return _mm256_broadcastd_epi32(_mm_loadu_si32(twice));
  }
};

/// Makes a block from `first`; if not all of its pixels are kept, from `second` too.
template <Layout layout, Kept kept, WindowPart part>
[[gnu::always_inline]] inline Pixels make_block(const TileJob& job, const BlockAt& first,
                                                const BlockAt& second, __m256i lanes_u,
                                                __m256i lanes_v) {
  constexpr bool kOfTwo = kept != Kept::All;
  const auto place = [](__m256i lower, __m256i upper) {
    return kOfTwo ? _mm256_blend_epi32(lower, upper, 0xf0) : lower;
  };
  const Places places(_mm256_add_epi16(lanes_u, place(first.place_u(), second.place_u())),
                      _mm256_add_epi16(lanes_v, place(first.place_v(), second.place_v())),
                      Tables<info(layout).pixel_bytes, kOfTwo, part.columns>::kByHalves);
  Pixels pixels = sample<layout, kept, part>(first.window<layout>(job), second.window<layout>(job),
                                             job.source.stride, places);
  if constexpr (kept == Kept::EvenColumns) {
    // Rows of two pixels from each half.
    const __m256i order = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7);
    pixels.first = _mm256_permutevar8x32_epi32(pixels.first, order);
    pixels.more = _mm256_permutevar8x32_epi32(pixels.more, order);
  }
  return pixels;
}

/// Fills one row of blocks; block (0, y) has the lanes that u and v start from. If not all pixels
/// are kept, blocks are made from pairs of blocks: two side by side, or this row's and the next
/// one's.
template <Layout layout, int blocks_x, Kept kept, WindowPart part>
void fill_row(const TileJob& job, const BlockRow* row, const Shape& u, const Shape& v,
              std::uint8_t* out) {
  constexpr int kOutBytes = info(layout).out_bytes(), kStep = kept == Kept::EvenColumns ? 2 : 1;
  constexpr int kGroup = group_of(kOutBytes), kMade = blocks_x / kStep;
  constexpr int kCount = kGroup < kMade ? kGroup : kMade;
  constexpr int kBeside = kept == Kept::EvenColumns ? 1 : 0,
                kBelow = kept == Kept::EvenRows ? 1 : 0;
  __m256i lanes_u = u.start, lanes_v = v.start;
#pragma GCC unroll 1
  for (int x = 0; x < kMade; x += kCount) {
    Pixels pixels[kGroup]{};
#pragma GCC unroll 4
    for (int k = 0; k < kCount; ++k) {
      const int block = kStep * (x + k);
      pixels[k] = make_block<layout, kept, part>(job, {row[0], block},
                                                 {row[kBelow], block + kBeside}, lanes_u, lanes_v);
      lanes_u = _mm256_add_epi16(lanes_u, u.along_x);
      lanes_v = _mm256_add_epi16(lanes_v, v.along_x);
    }
    const auto rows = rows_of<kOutBytes>(pixels);
    constexpr int kBytes = kCount * kBlock * kOutBytes;
    const std::ptrdiff_t stride = job.target.stride;
    store_rows<kBytes>(rows.even, out, out + 2 * stride);
    store_rows<kBytes>(rows.odd, out + stride, out + 3 * stride);
    out += kBytes;
  }
}

template <Layout layout, int blocks_x, Kept kept, WindowPart part>
void fill_rows(const TileJob& job) {
  BlockRow rows[kMostRows];
  walk(job.map, rows);
  using Axes = AxisPair<std::int16_t>;
  const LaneShape& lanes = job.map.lanes;
  Shape u(lanes, &Axes::u, lanes.offset.u, kept), v(lanes, &Axes::v, lanes.offset.v, kept);
  v.round_to_rows();
  u.step_by_pairs(kept);
  v.step_by_pairs(kept);
  std::uint8_t* out = job.target.data;
  constexpr int kStep = kept == Kept::EvenRows ? 2 : 1;
  for (int y = 0; y < job.map.blocks_y; y += kStep) {
    fill_row<layout, blocks_x, kept, part>(job, &rows[y], u, v, out);
    u.start = _mm256_add_epi16(u.start, u.along_y);
    v.start = _mm256_add_epi16(v.start, v.along_y);
    out += kBlock * job.target.stride;
  }
}

/// Fills a tile from as little of the windows as it needs.
template <Layout layout, int blocks_x, Kept kept>
void fill(const TileJob& job) {
  const bool has_few_rows = job.map.is_within(kWindow, kFewRows);
  if constexpr (info(layout).pixel_bytes == 3) {
    if (job.map.is_within(kFewColumns, kWindow)) {
      constexpr WindowPart kFew{kFewColumns, kFewRows}, kNarrow{kFewColumns, kWindow};
      return has_few_rows ? fill_rows<layout, blocks_x, kept, kFew>(job)
                          : fill_rows<layout, blocks_x, kept, kNarrow>(job);
    }
  }
  constexpr WindowPart kLow{kWindow, kFewRows};
  has_few_rows ? fill_rows<layout, blocks_x, kept, kLow>(job)
               : fill_rows<layout, blocks_x, kept, kWhole>(job);
}

template <Layout layout, Kept kept>
void fill_tile(const TileJob& job) {
  if (job.map.blocks_x == kMostBlocks) return fill<layout, kMostBlocks, kept>(job);
  if constexpr (kept == Kept::All) {
    if (job.map.blocks_x == 1) return fill_rows<layout, 1, kept, kWhole>(job);
  }
  fill<layout, kMostBlocks / 2, kept>(job);
}

template <Kept kept>
constexpr auto kTiles = by_layout<kKernelLayouts>([]<Layout layout>() -> Kernel::Tile {
  return fill_tile<layout, kept>;
});

using PointLanes [[gnu::vector_size(32)]] = std::uint32_t;

}  // namespace

extern const Kernel kKernel;
constexpr Kernel kKernel{
    .name = "avx2",
    .tiles = kTiles<Kept::All>,
    .locate = walk_places<PointLanes>,
    .points = kPointWalks,
    .mix = mix_pairs,
    .mix_yuv420 = mix_yuv420_tiles,
    .look_up = look_up_words,
    .look_up_yuv420 = look_up_yuv420_planes,
    .find_entries = find_entries,
    .write_rgb = write_rgb,
    .even_columns = kTiles<Kept::EvenColumns>,
    .even_rows = kTiles<Kept::EvenRows>,
    .fetches_ahead = true,
};

}  // namespace orbwatch::remap::avx2
