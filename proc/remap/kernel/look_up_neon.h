// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arm_neon.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "proc/image/image_view.h"
#include "proc/remap/colour/colour_table.h"
#include "proc/remap/colour/planar_tile.h"
#include "proc/remap/colour/run.h"
#include "proc/remap/colour/yuv420_tile.h"
#include "proc/remap/kernel/narrow_neon.h"

// Colour lookup of the kernel for NEON, and the indices for it: the table of a channel fills half
// of the registers.

namespace orbwatch::remap::neon {
namespace {

/// Calls `walk` with a function that finds 16 indices' entries in the table of a channel. The
/// table's parts are variables, since g++ would keep those of an object in memory.
template <class Walk>
[[gnu::always_inline]] inline void with_table(const std::array<std::uint8_t, 256>& plane,
                                              const Walk& walk) {
  const uint8x16x4_t first = vld1q_u8_x4(&plane[0]), second = vld1q_u8_x4(&plane[64]),
                     third = vld1q_u8_x4(&plane[128]), fourth = vld1q_u8_x4(&plane[192]);
  walk([&](const std::uint8_t* indices) __attribute__((always_inline)) {
    const uint8x16_t index = vld1q_u8(indices);
    // An index beyond its part of the table keeps the earlier result.
    uint8x16_t found = vqtbl4q_u8(first, index);
    found = vqtbx4q_u8(found, second, vsubq_u8(index, vdupq_n_u8(64)));
    found = vqtbx4q_u8(found, third, vsubq_u8(index, vdupq_n_u8(128)));
    return vqtbx4q_u8(found, fourth, vsubq_u8(index, vdupq_n_u8(192)));
  });
}

/// Looks up one channel of all runs.
[[gnu::always_inline]] inline void look_up_plane(const std::array<std::uint8_t, 256>& plane,
                                                 const IndexRuns& runs, std::uint8_t* out,
                                                 std::ptrdiff_t out_stride) {
  with_table(
      plane, [&](const auto& entries) __attribute__((always_inline)) {
        const std::uint8_t* indices = runs.first;
        std::uint8_t* to = out;
#pragma GCC unroll 4
        for (int rows = runs.rows; rows > 0; --rows, indices += runs.stride, to += out_stride) {
          vst1q_u8(to, entries(indices));
        }
      });
}

/// Implements Kernel::look_up: one channel after the other, since the registers do not hold three
/// tables.
inline void look_up_colours(const ColourTable& table, const IndexRuns& runs,
                            const ImageView<std::uint8_t>& out) {
  if (table.channels == 1) return look_up_plane(table.planes[0], runs, out.data, out.stride);
  alignas(kRun) std::uint8_t found[3][kTile * kRun];
  for (std::size_t k = 0; k < 3; ++k) look_up_plane(table.planes[k], runs, found[k], kRun);
  std::uint8_t* to = out.data;
#pragma GCC unroll 4
  for (int at = 0; at < runs.rows * kRun; at += kRun, to += out.stride) {
    const uint8x16x3_t pixels{
        {vld1q_u8(found[0] + at), vld1q_u8(found[1] + at), vld1q_u8(found[2] + at)}};
    vst3q_u8(to, pixels);
  }
}

/// Implements Kernel::look_up_planes.
inline void look_up_planes(const ColourTable& table, const std::uint8_t* indices, PlanarTile& out) {
  for (std::size_t channel = 0; channel < 3; ++channel) {
    std::uint8_t* const to = out.plane(channel);
    with_table(
        table.planes[channel], [&](const auto& entries) __attribute__((always_inline)) {
#pragma GCC unroll 16
          for (int at = 0; at < kTile * kRun; at += kRun) vst1q_u8(to + at, entries(indices + at));
        });
  }
}

/// Looks up a channel of chroma: the means of each two by two indices' entries.
[[gnu::always_inline]] inline void look_up_chroma(const std::array<std::uint8_t, 256>& plane,
                                                  const IndexRuns& runs, Yuv420Planes::Plane out) {
  with_table(
      plane, [&](const auto& entries) __attribute__((always_inline)) {
        const std::uint8_t* indices = runs.first;
        std::uint8_t* to = out.first;
#pragma GCC unroll 4
        for (int y = 0; y < Yuv420Tile::kChromaRows; ++y, to += out.stride) {
          const uint8x16_t upper = entries(indices), lower = entries(indices + runs.stride);
          vst1_u8(to, vrshrn_n_u16(vpadalq_u8(vpaddlq_u8(upper), lower), 2));
          indices += 2 * runs.stride;
        }
      });
}

/// Implements Kernel::look_up_yuv420.
inline void look_up_yuv420(const ColourTable& table, const IndexRuns& runs,
                           const Yuv420Planes& out) {
  look_up_plane(table.planes[0], {runs.first, runs.stride, kTile}, out.y.first, out.y.stride);
  look_up_chroma(table.planes[1], runs, out.u);
  look_up_chroma(table.planes[2], runs, out.v);
}

/// Implements Kernel::find_entries: a difference that saturates is the clamp below.
inline void find_table_entries(const ValueScale& scale,
                               const ImageView<const std::uint16_t>& values,
                               std::uint8_t* entries) {
  const uint16x8_t low = vdupq_n_u16(scale.low);
  const uint16x8_t most = vdupq_n_u16(static_cast<std::uint16_t>(scale.high - scale.low));
  const uint16x8_t unit = vdupq_n_u16(scale.unit), step = vdupq_n_u16(scale.scale);
  const auto halved = [&](const std::uint16_t* from) __attribute__((always_inline)) {
    const uint16x8_t above = vminq_u16(vqsubq_u16(vld1q_u16(from), low), most);
    const uint16x8_t upper = vmulq_u16(above, unit);
    const uint32x4_t first = vmull_u16(vget_low_u16(upper), vget_low_u16(step));
    const uint32x4_t second = vmull_high_u16(upper, step);
    return vuzp2q_u16(vreinterpretq_u16_u32(first), vreinterpretq_u16_u32(second));
  };
  const std::uint16_t* from = values.data;
  const std::ptrdiff_t stride = values.stride;
#pragma GCC unroll 4
  for (int rows = values.height; rows > 0; --rows, from += stride, entries += kRun) {
    vst1q_u8(entries, rounded_shift<kEntryBits>(halved(from), halved(from + kRun / 2)));
  }
}

}  // namespace
}  // namespace orbwatch::remap::neon
