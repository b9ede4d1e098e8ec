// SPDX-License-Identifier: Apache-2.0
// The kernel for AVX2. One register holds 16 bit for each of a block's 16 pixels, row by row. A
// channel's window of 8 rows of 8 bytes is four tables for vpshufb, two rows each, in both halves
// of a register. Gather is not used: mitigations make it slow.
//
// The arithmetic is the scalar kernel's, with negative weights, because a unit weight of 128 fits a
// signed byte only that way: a (w - 128) + b (-w) = -top, at most 255 * 128 in size. A 16 bit
// sample is interpolated as two bytes, whose exact sums are added before they are rounded.

#include <immintrin.h>

#include <cstddef>
#include <cstring>

#include "proc/remap/kernel/bilinear.h"
#include "proc/remap/kernel/look_up.h"
#include "proc/remap/kernel/point_walk.h"
#include "proc/remap/kernel/tile_mix.h"
#include "proc/remap/kernel/yuv420_mix.h"

namespace orbwatch::remap::avx2 {
namespace {

constexpr int kMostBlocks = kTile / kBlock, kMostRows = 2 * kMostBlocks;

__m128i load128(const void* from) { return _mm_loadu_si128(static_cast<const __m128i*>(from)); }
__m256i each(int value) { return _mm256_set1_epi16(static_cast<short>(value)); }

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

/// One axis: the lanes of block (0, 0) without its place, and their steps from block to block.
struct Shape {
  using Axis = std::int16_t AxisPair<std::int16_t>::*;
  __m256i start, along_x, along_y;

  Shape(const LaneShape& shape, Axis axis, std::uint16_t offset) {
    const __m256i i = _mm256_set1_epi64x(0x0003000200010000);
    const __m256i j = _mm256_setr_epi16(0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
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
};

/// Positions and weights for the interpolation of a block's pixels.
struct Places {
  /// Indices of the two upper neighbours in each of the four tables of a channel, and of the two
  /// lower ones. Bit 7 is set, so that vpshufb yields 0, if they lie before that table.
  __m256i upper[4], lower[4];
  __m256i across;  ///< weights w - 128, -w along u
  __m256i v;

  Places(__m256i u, __m256i lanes_v) : v(lanes_v) {
    constexpr int kRowShift = kRowFractionBits - 3;
    const __m256i whole =
        _mm256_or_si256(_mm256_srli_epi16(u, kFractionBits),
                        _mm256_and_si256(_mm256_srli_epi16(v, kRowShift), each(7 << 3)));
    upper[0] = _mm256_add_epi16(_mm256_mullo_epi16(whole, each(0x0101)), each(0x0100));
    lower[0] = _mm256_add_epi8(upper[0], _mm256_set1_epi8(kWindow));
#pragma GCC unroll 4
    for (int table = 1; table < 4; ++table) {
      const __m256i size = _mm256_set1_epi8(2 * kWindow);
      upper[table] = _mm256_sub_epi8(upper[table - 1], size);
      lower[table] = _mm256_sub_epi8(lower[table - 1], size);
    }
    const __m256i w =
        _mm256_and_si256(_mm256_srli_epi16(u, kFractionBits - kWeightBits), each(kUnitWeight - 1));
    across = _mm256_xor_si256(_mm256_mullo_epi16(w, each(1 - 256)), each(kUnitWeight));
  }
};

/// One byte of each pixel's sample, times -kUnitWeight: interpolated along u in the rows above and
/// below.
struct Rows {
  __m256i top, bottom;
};

/// Interpolates one channel of a window, 8 rows of 8 bytes that are `stride` apart.
[[gnu::always_inline]] inline Rows interpolate_rows(const std::uint8_t* from, std::ptrdiff_t stride,
                                                    const Places& places) {
  const auto table = [=](int k) {
    const auto row = [=](int r) {
      return _mm256_broadcastq_epi64(_mm_loadu_si64(from + r * stride));
    };
    return _mm256_blend_epi32(row(2 * k), row(2 * k + 1), 0xcc);
  };
  // A lookup hits its table and all before it. Each table except the first is therefore the
  // exclusive or of two, and the results are combined by exclusive or.
  __m256i before = table(0);
  __m256i upper = _mm256_shuffle_epi8(before, places.upper[0]);
  __m256i lower = _mm256_shuffle_epi8(before, places.lower[0]);
#pragma GCC unroll 4
  for (int k = 1; k < 4; ++k) {
    const __m256i next = table(k), change = _mm256_xor_si256(before, next);
    upper = _mm256_xor_si256(upper, _mm256_shuffle_epi8(change, places.upper[k]));
    lower = _mm256_xor_si256(lower, _mm256_shuffle_epi8(change, places.lower[k]));
    before = next;
  }
  return {_mm256_maddubs_epi16(upper, places.across), _mm256_maddubs_epi16(lower, places.across)};
}

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

/// A window split into channels: each row has first 8 bytes of one channel, then 8 of the next.
template <int pixel_bytes>
struct Planar {
  static constexpr int kPitch = pixel_bytes == 2 ? 16 : 32;
  alignas(32) std::uint8_t rows[kWindow * kPitch];

  void fill(const std::uint8_t* from, std::ptrdiff_t stride) {
#pragma GCC unroll 8
    for (int row = 0; row < kWindow; ++row, from += stride) split(from, rows + row * kPitch);
  }

 private:
  static void split(const std::uint8_t* from, std::uint8_t* to) {
    if constexpr (pixel_bytes == 2) {
      const __m128i by_channel =
          _mm_setr_epi8(0, 2, 4, 6, 8, 10, 12, 14, 1, 3, 5, 7, 9, 11, 13, 15);
      _mm_store_si128(reinterpret_cast<__m128i*>(to), _mm_shuffle_epi8(load128(from), by_channel));
    } else {
      // Four pixels are in each half. Reads of three byte pixels do not go beyond the row's 24
      // bytes.
      constexpr int kSecond = pixel_bytes == 3 ? 8 : 16;
      const __m256i pixels = _mm256_inserti128_si256(_mm256_castsi128_si256(load128(from)),
                                                     load128(from + kSecond), 1);
      const __m256i by_channel =
          pixel_bytes == 3
              ? _mm256_setr_epi8(0, 3, 6, 9, 1, 4, 7, 10, 2, 5, 8, 11, -1, -1, -1, -1,  //
                                 4, 7, 10, 13, 5, 8, 11, 14, 6, 9, 12, 15, -1, -1, -1, -1)
              : _mm256_broadcastsi128_si256(
                    _mm_setr_epi8(0, 4, 8, 12, 1, 5, 9, 13, 2, 6, 10, 14, 3, 7, 11, 15));
      const __m256i halves = _mm256_setr_epi32(0, 4, 1, 5, 2, 6, 3, 7);
      _mm256_store_si256(
          reinterpret_cast<__m256i*>(to),
          _mm256_permutevar8x32_epi32(_mm256_shuffle_epi8(pixels, by_channel), halves));
    }
  }
};

/// The block's pixels: up to 16 bit of each in `first`, further bits in `more`.
struct Pixels {
  __m256i first, more;
};

/// Samples channels in rows of `stride`, each kWindow bytes after the one before.
template <Layout layout>
[[gnu::always_inline]] inline Pixels sample(const std::uint8_t* from, std::ptrdiff_t stride,
                                            const Places& places) {
  constexpr int kFirst = info(layout).first, kEvery = info(layout).every;
  constexpr int kSamples = info(layout).samples;
  const auto rows = [&](int byte) {
    return interpolate_rows(from + byte * kWindow, stride, places);
  };
  if constexpr (info(layout).sample_bytes == 2) {
    return {sample16(rows(0), rows(1), places.v), _mm256_setzero_si256()};
  } else {
    const auto channel = [&](int k) { return sample8(rows(kFirst + k * kEvery), places.v); };
    const auto pair = [&](int k) {
      return _mm256_or_si256(channel(k), _mm256_slli_epi16(channel(k + 1), 8));
    };
    if constexpr (kSamples == 1) return {channel(0), _mm256_setzero_si256()};
    if constexpr (kSamples == 2) return {pair(0), _mm256_setzero_si256()};
    if constexpr (kSamples == 3) return {pair(0), channel(2)};
    if constexpr (kSamples == 4) return {pair(0), pair(2)};
  }
}

/// Number of adjacent blocks that make rows of 16 bytes, or of 12 if a pixel has three.
constexpr int group_of(int out_bytes) { return out_bytes == 3 ? 1 : 4 / out_bytes; }

/// The rows of a group of blocks: 0 and 2, 1 and 3.
struct GroupRows {
  __m256i even, odd;
};

template <int out_bytes>
GroupRows rows_of(const Pixels (&blocks)[group_of(out_bytes)]) {
  if constexpr (out_bytes == 1) {
    const auto four = [](const Pixels& left, const Pixels& right) {
      return _mm256_castsi256_ps(_mm256_packus_epi16(left.first, right.first));
    };
    const __m256 left = four(blocks[0], blocks[1]), right = four(blocks[2], blocks[3]);
    return {_mm256_castps_si256(_mm256_shuffle_ps(left, right, 0x88)),
            _mm256_castps_si256(_mm256_shuffle_ps(left, right, 0xdd))};
  } else if constexpr (out_bytes == 2) {
    return {_mm256_unpacklo_epi64(blocks[0].first, blocks[1].first),
            _mm256_unpackhi_epi64(blocks[0].first, blocks[1].first)};
  } else {
    const __m256i even = _mm256_unpacklo_epi16(blocks[0].first, blocks[0].more);
    const __m256i odd = _mm256_unpackhi_epi16(blocks[0].first, blocks[0].more);
    if constexpr (out_bytes == 4) return {even, odd};
    const __m256i three = _mm256_broadcastsi128_si256(
        _mm_setr_epi8(0, 1, 2, 4, 5, 6, 8, 9, 10, 12, 13, 14, -1, -1, -1, -1));
    return {_mm256_shuffle_epi8(even, three), _mm256_shuffle_epi8(odd, three)};
  }
}

template <int bytes>
void store_row(__m128i row, std::uint8_t* out) {
  if constexpr (bytes == 16) {
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out), row);
  } else if constexpr (bytes == 4) {
    _mm_storeu_si32(out, row);
  } else {
    _mm_storeu_si64(out, row);
    if constexpr (bytes == 12) _mm_storeu_si32(out + 8, _mm_srli_si128(row, 8));
  }
}

template <Layout layout>
const std::uint8_t* begin(const TileJob& job, const AxisPair<std::int64_t>& window) {
  return job.source.data + (window.v >> 32) * job.source.stride +
         (window.u >> 32) * info(layout).pixel_bytes;
}

/// Fills one row of blocks; block (0, y) has the lanes that u and v start from.
template <Layout layout, int blocks_x>
void fill_row(const TileJob& job, const BlockRow& row, const Shape& u, const Shape& v,
              std::uint8_t* out) {
  constexpr int kPixelBytes = info(layout).pixel_bytes, kOutBytes = info(layout).out_bytes();
  constexpr int kGroup = group_of(kOutBytes), kCount = kGroup < blocks_x ? kGroup : blocks_x;
  // All windows are loaded first, and the loop is not unrolled: else the compiler extracts the
  // channels from vectors instead of reading them back, which takes longer.
  [[maybe_unused]] Planar<kPixelBytes> planar[blocks_x];
  if constexpr (kPixelBytes > 1) {
#pragma GCC unroll 1
    for (int x = 0; x < blocks_x; ++x) {
      planar[x].fill(begin<layout>(job, row.windows[x]), job.source.stride);
    }
  }
  __m256i lanes_u = u.start, lanes_v = v.start;
#pragma GCC unroll 1
  for (int x = 0; x < blocks_x; x += kCount) {
    Pixels pixels[kGroup]{};
#pragma GCC unroll 4
    for (int k = 0; k < kCount; ++k) {
      const auto& place = row.places[x + k];
      const Places places(
          _mm256_add_epi16(lanes_u, _mm256_broadcastd_epi32(_mm_loadu_si32(&place.u))),
          _mm256_add_epi16(lanes_v, _mm256_broadcastd_epi32(_mm_loadu_si32(&place.v))));
      if constexpr (kPixelBytes > 1) {
        pixels[k] = sample<layout>(planar[x + k].rows, Planar<kPixelBytes>::kPitch, places);
      } else {
        pixels[k] =
            sample<layout>(begin<layout>(job, row.windows[x + k]), job.source.stride, places);
      }
      lanes_u = _mm256_add_epi16(lanes_u, u.along_x);
      lanes_v = _mm256_add_epi16(lanes_v, v.along_x);
    }
    const GroupRows rows = rows_of<kOutBytes>(pixels);
    constexpr int kBytes = kCount * kBlock * kOutBytes;
    store_row<kBytes>(_mm256_castsi256_si128(rows.even), out);
    store_row<kBytes>(_mm256_castsi256_si128(rows.odd), out + job.target.stride);
    store_row<kBytes>(_mm256_extracti128_si256(rows.even, 1), out + 2 * job.target.stride);
    store_row<kBytes>(_mm256_extracti128_si256(rows.odd, 1), out + 3 * job.target.stride);
    out += kBytes;
  }
}

template <Layout layout, int blocks_x>
void fill_rows(const TileJob& job) {
  BlockRow rows[kMostRows];
  walk(job.map, rows);
  using Axes = AxisPair<std::int16_t>;
  const LaneShape& lanes = job.map.lanes;
  Shape u(lanes, &Axes::u, lanes.offset.u), v(lanes, &Axes::v, lanes.offset.v);
  v.round_to_rows();
  std::uint8_t* out = job.target.data;
  for (int y = 0; y < job.map.blocks_y; ++y) {
    fill_row<layout, blocks_x>(job, rows[y], u, v, out);
    u.start = _mm256_add_epi16(u.start, u.along_y);
    v.start = _mm256_add_epi16(v.start, v.along_y);
    out += kBlock * job.target.stride;
  }
}

template <Layout layout>
void fill_tile(const TileJob& job) {
  if (job.map.blocks_x == kMostBlocks) return fill_rows<layout, kMostBlocks>(job);
  if (job.map.blocks_x == 1) return fill_rows<layout, 1>(job);
  fill_rows<layout, kMostBlocks / 2>(job);
}

using PointLanes [[gnu::vector_size(32)]] = std::uint32_t;

}  // namespace

extern const Kernel kKernel;
constexpr Kernel kKernel{
    .name = "avx2",
    .tiles = by_layout<kKernelLayouts>(
        []<Layout layout>() -> Kernel::Tile { return fill_tile<layout>; }),
    .locate = walk_places<PointLanes>,
    .points = kPointWalks,
    .mix = mix_tiles,
    .mix_yuv420 = mix_yuv420_tiles,
    .look_up = look_up_words,
    .look_up_yuv420 = look_up_yuv420_planes,
    .fetches_ahead = true,
};

}  // namespace orbwatch::remap::avx2
