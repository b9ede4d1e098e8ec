// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "proc/image/result.h"

/// The code by which a browser on another computer sets the first password. Kept in plain text, so
/// that `orbwatch password --show` can print it, and only while there is no password. All
/// reentrant; functions with a folder wait for the disk.
namespace orbwatch::app::web {

/// Eight letters and digits without similar ones, "K7QX-2M9P": 40 random bits, sufficient because
/// guesses are limited.
std::string random_code();

/// Compares in any case, with or without the dash, with O for 0 and I or L for 1. Takes constant
/// time for wrong codes.
bool is_code(std::string_view code, std::string_view typed);

/// Reads the kept code; nullopt: none. Errors: those of read_private().
Result<std::optional<std::string>> kept_code(const std::filesystem::path& state_folder);

/// Returns the kept code, or creates and keeps a new one. Errors: those of read_private() and
/// write_private().
Result<std::string> keep_code(const std::filesystem::path& state_folder);

/// Removes the kept code. Error: it cannot be removed.
Result<> forget_code(const std::filesystem::path& state_folder);

}  // namespace orbwatch::app::web
