#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace orbwatch::app {

/// The state of a file at one moment, to find out whether it was changed since.
struct FileVersion {
  std::uint32_t checksum = 0;  ///< CRC-32 of its bytes; 0: it is absent, unreadable or empty
  std::string time;            ///< of the newest change, UTC as ISO 8601; empty: there is no file
  std::string account;         ///< its owner, who usually made that change
};

/// Waits for the disk. Reentrant.
FileVersion version_of(const std::filesystem::path& file);

/// "rig.toml was changed by root at 2026-11-21T20:57:46Z", or that it was removed, for a file that
/// is called `name` there.
std::string change_text(const std::string& name, const FileVersion& now);

}  // namespace orbwatch::app
