// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "proc/image/result.h"

/// One frame of Zstandard (RFC 8878) with its size and checksum. All reentrant.
namespace orbwatch::app::cli {

/// Error: out of memory.
Result<std::string> compressed(std::string_view bytes);

/// Bytes of any origin; never allocates more than `most` bytes for the result. Errors: not such a
/// frame, damaged, larger than `most`, followed by other bytes.
Result<std::string> decompressed(std::string_view bytes, std::size_t most);

}  // namespace orbwatch::app::cli
