// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "proc/image/image_view.h"
#include "proc/remap/colour/colour_table.h"
#include "proc/remap/colour/run.h"
#include "proc/remap/colour/yuv420_tile.h"

// Colour lookup of kernels whose instruction set does not hold a table in registers. Included by
// each of them, in an unnamed namespace for the same reason as point_walk.h.

namespace orbwatch::remap {
namespace {

/// Implements Kernel::look_up.
inline void look_up_words(const ColourTable& table, const IndexRuns& runs,
                          const ImageView<std::uint8_t>& out) {
  const std::uint8_t* indices = runs.first;
  std::uint8_t* to = out.data;
  int rows = runs.rows;
  if (table.channels == 3 && out.stride == 3 * kRun) {
    // The last word's unused byte belongs to the next run.
    for (; rows > 1; --rows, indices += runs.stride, to += out.stride) {
      for (int x = 0; x < kRun; ++x) std::memcpy(to + 3 * x, &table.words[indices[x]], 4);
    }
  }
  for (; rows > 0; --rows, indices += runs.stride, to += out.stride) {
    table.look_up(indices, kRun, to);
  }
}

/// Implements Kernel::look_up_yuv420.
inline void look_up_yuv420_planes(const ColourTable& table, const IndexRuns& runs,
                                  const Yuv420Planes& out) {
  const auto& [luma, u, v] = table.planes;
  for (int y = 0; y < kTile; y += 2) {
    const std::uint8_t* const upper = runs.first + y * runs.stride;
    const std::uint8_t* const lower = upper + runs.stride;
    for (int x = 0; x < kRun; ++x) out.y.row(y)[x] = luma[upper[x]];
    for (int x = 0; x < kRun; ++x) out.y.row(y + 1)[x] = luma[lower[x]];
    const auto mean = [&](const std::array<std::uint8_t, 256>& plane, int x) {
      const int sum = plane[upper[x]] + plane[upper[x + 1]] + plane[lower[x]] + plane[lower[x + 1]];
      return static_cast<std::uint8_t>((sum + 2) / 4);
    };
    for (int x = 0; x < kRun; x += 2) out.u.row(y / 2)[x / 2] = mean(u, x);
    for (int x = 0; x < kRun; x += 2) out.v.row(y / 2)[x / 2] = mean(v, x);
  }
}

}  // namespace
}  // namespace orbwatch::remap
