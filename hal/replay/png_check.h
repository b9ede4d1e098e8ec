#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "proc/image/result.h"

namespace orbwatch::hal {

/// What the header of a PNG picture states.
struct PngSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// True when `file` starts as a PNG picture does.
bool is_png(std::span<const std::byte> file);

/// Walks the chunks of a PNG picture up to its end and checks the sum of each (ISO/IEC 15948, 5.3),
/// so that the decoder, which is lenient and prints to stderr, meets whole files only. Errors: not
/// a PNG picture, ends early, damaged. Reentrant.
Result<PngSize> check_png(std::span<const std::byte> file);

}  // namespace orbwatch::hal
