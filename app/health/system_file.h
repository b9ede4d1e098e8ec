#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orbwatch::app {

/// The start of a file that the kernel makes up, at most 16 KiB; nothing when it cannot be read.
/// Never waits, whatever the file is. Reentrant.
std::optional<std::string> read_system_file(const std::filesystem::path& file);

/// A whole text that is one number, with white space around it; nothing when it is not. Base 16 may
/// begin with 0x. Reentrant.
std::optional<std::int64_t> to_integer(std::string_view text, int base = 10);

/// The number that a file holds. Reentrant.
std::optional<std::int64_t> read_integer(const std::filesystem::path& file, int base = 10);

/// What a folder holds, in any order; nothing when it cannot be listed. Reentrant.
std::vector<std::filesystem::path> entries(const std::filesystem::path& folder);

/// The same, of names that begin with `prefix`.
std::vector<std::filesystem::path> entries(const std::filesystem::path& folder,
                                           std::string_view prefix);

}  // namespace orbwatch::app
