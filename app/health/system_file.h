// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace orbwatch::app {

/// The first `most` bytes of a file of procfs or sysfs, 16 KiB by default; nullopt when it cannot
/// be read. Never blocks, for any kind of file. Reentrant.
std::optional<std::string> read_system_file(const std::filesystem::path& file,
                                            std::size_t most = std::size_t{16} << 10);

/// Parses a text that is one number, with white space around it; else nullopt. Base 16 may begin
/// with 0x. Reentrant.
std::optional<std::int64_t> to_integer(std::string_view text, int base = 10);

/// Reads the number in a file. Reentrant.
std::optional<std::int64_t> read_integer(const std::filesystem::path& file, int base = 10);

/// Value of a line "key:   123 kB" in a file of lines, bytes; nullopt: no such line. Reentrant.
std::optional<std::uint64_t> memory_line(const std::filesystem::path& file, std::string_view key);

/// The entries of a folder, in any order; empty when it cannot be listed. Reentrant.
std::vector<std::filesystem::path> entries(const std::filesystem::path& folder);

/// Entries whose names begin with `prefix`.
std::vector<std::filesystem::path> entries(const std::filesystem::path& folder,
                                           std::string_view prefix);

}  // namespace orbwatch::app
