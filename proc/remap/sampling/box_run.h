// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "proc/remap/kernel/layout.h"

namespace orbwatch::remap {

/// Number of pixels of a layout that box_run() makes; 0: none, compilers generate equally good
/// code.
constexpr int box_run_pixels([[maybe_unused]] Layout layout) {
#ifdef __aarch64__
  if (layout == Layout::One8) return 8;
  if (layout == Layout::Two8 || layout == Layout::One16) return 4;
#endif
  return 0;
}

/// Writes the next box_run_pixels() of a BoxFilter's row.
template <Layout layout>
void box_run(const std::uint8_t* upper, const std::uint8_t* lower, std::uint8_t* out);

}  // namespace orbwatch::remap

#ifdef __aarch64__
#include "proc/remap/sampling/box_run_neon.h"
#endif
