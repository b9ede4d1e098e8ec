#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "proc/image/result.h"

/// The code by which a browser on another computer sets the first password. Kept as it is, so that
/// `orbwatch password --show` can print it, and only as long as nobody has a password. All
/// reentrant; what has a folder waits for the disk.
namespace orbwatch::app::web {

/// Eight letters and digits that nobody takes for each other, "K7QX-2M9P": 40 random bits, which
/// are as good as more where guesses are limited.
std::string random_code();

/// In any case, with or without the dash, with O for 0 and I or L for 1. Takes as long for any
/// wrong one.
bool is_code(std::string_view code, std::string_view typed);

/// Nullopt: none is kept. Errors: as read_private().
Result<std::optional<std::string>> kept_code(const std::filesystem::path& state_folder);

/// The kept one, else a new one, which is kept. Errors: as read_private() and write_private().
Result<std::string> keep_code(const std::filesystem::path& state_folder);

/// Error: it is there, and stays.
Result<> forget_code(const std::filesystem::path& state_folder);

}  // namespace orbwatch::app::web
