// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::app::cli {

/// One frame of Zstandard (RFC 8878) with its size and checksum; see frame_stream.h for its reader.
/// Error: out of memory. Reentrant.
Result<std::string> compressed(std::string_view bytes);

}  // namespace orbwatch::app::cli
