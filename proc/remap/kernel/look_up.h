// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "proc/image/image_view.h"
#include "proc/remap/colour/colour_table.h"
#include "proc/remap/colour/run.h"

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

}  // namespace
}  // namespace orbwatch::remap
