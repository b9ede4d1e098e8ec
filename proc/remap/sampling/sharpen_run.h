// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

/// A sample by the specification in sharpening.h, and `RunSharpener`, which does the same for 16
/// samples: `sharpen_run_neon.h` where compilers do not generate the processor's instructions by
/// themselves, else `sharpen_run_any.h`.
namespace orbwatch::remap {

inline constexpr int kSharpenedRun = 16;

/// `beside`, `corners`: sums of the four samples there. Twice the difference fits 16 bits, and
/// processors have an instruction for the upper half of its product with the gain.
[[gnu::always_inline]] inline std::uint8_t sharpened_sample(int sample, int beside, int corners,
                                                            std::int16_t gain) {
  const auto twice = static_cast<std::int16_t>(2 * (60 * sample - 11 * beside - 4 * corners));
  const auto eighths = static_cast<std::int16_t>((twice * gain) >> 16);
  const auto sum = static_cast<std::int16_t>(sample + ((eighths + 4) >> 3));
  return static_cast<std::uint8_t>(std::clamp<std::int16_t>(sum, 0, 255));
}

}  // namespace orbwatch::remap

#ifdef __aarch64__
#include "proc/remap/sampling/sharpen_run_neon.h"
#else
#include "proc/remap/sampling/sharpen_run_any.h"
#endif
