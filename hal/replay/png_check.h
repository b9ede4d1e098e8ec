// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "proc/image/result.h"

namespace orbwatch::hal {

/// Size from the header of a PNG picture.
struct PngSize {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
};

/// True when `file` starts with the signature of PNG.
bool is_png(std::span<const std::byte> file);

/// Checks the CRC of each chunk of a PNG picture up to its end (ISO/IEC 15948, 5.3), as the decoder
/// is lenient and prints to stderr. Errors: not a PNG picture, truncated, damaged. Reentrant.
Result<PngSize> check_png(std::span<const std::byte> file);

}  // namespace orbwatch::hal
