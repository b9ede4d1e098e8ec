// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// Makes a folder of this user alone, unless it is there. Error: the disk.
Result<> make_owners_folder(const std::filesystem::path& folder);

/// Adds bytes to an uploaded file, which only its owner can read; at offset 0 a new one begins.
/// Returns its size. Errors: another offset than its size, the disk; the file is then as before.
/// Not for two threads with the same file.
Result<std::uint64_t> add_uploaded(const std::filesystem::path& file, std::uint64_t offset,
                                   std::string_view bytes);

}  // namespace orbwatch::app::daemon
