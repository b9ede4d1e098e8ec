// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace orbwatch::app::files {

/// State of a file at one moment, to detect later changes.
struct FileVersion {
  std::uint32_t checksum = 0;  ///< CRC-32 of its bytes; 0: it is absent, unreadable or empty
  std::string time;  ///< time of the newest change, UTC as ISO 8601; empty: the file does not exist
  std::string account;  ///< owner, who usually made that change
};

/// Reads the version; waits for the disk. Reentrant.
FileVersion version_of(const std::filesystem::path& file);

/// Text such as "rig.toml was changed by root at 2026-11-21T20:57:46Z", or that it was removed;
/// `name` is the file's name in it.
std::string change_text(const std::string& name, const FileVersion& now);

}  // namespace orbwatch::app::files
