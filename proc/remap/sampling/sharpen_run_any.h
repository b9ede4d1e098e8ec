// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

#include "proc/remap/sampling/sharpen_run.h"
#include "proc/remap/sampling/sharpening.h"

namespace orbwatch::remap {

/// Sharpens 16 adjacent samples that have neighbours, in loops that become vector code. See
/// sharpening.h.
class RunSharpener {
 public:
  [[gnu::always_inline]] RunSharpener(const RowsAround& rows, const SharpeningGains& gains)
      : rows_(rows) {
    for (std::size_t k = 0; k < gains_.size(); ++k) gains_[k] = gains[k % 2];
  }

  /// `even`: index of the first sample in its row, an even number.
  [[gnu::always_inline]] void operator()(std::ptrdiff_t even, std::uint8_t* out) const {
    const std::ptrdiff_t step = rows_.pixel_samples;
    const std::uint8_t *const above = rows_.above + even, *const row = rows_.row + even,
                              *const below = rows_.below + even;
    std::array<std::uint8_t, 16> run;
    for (std::ptrdiff_t k = 0; k < 16; ++k) {
      const int beside = above[k] + below[k] + row[k - step] + row[k + step];
      const int corners = above[k - step] + above[k + step] + below[k - step] + below[k + step];
      run[k] = sharpened_sample(row[k], beside, corners, gains_[k]);
    }
    std::memcpy(out + even, run.data(), run.size());
  }

 private:
  RowsAround rows_;
  std::array<std::int16_t, 16> gains_;
};

}  // namespace orbwatch::remap
