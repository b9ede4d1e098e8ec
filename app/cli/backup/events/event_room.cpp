// SPDX-License-Identifier: Apache-2.0
#include "app/cli/backup/events/event_room.h"

#include <limits>
#include <string>
#include <system_error>

namespace orbwatch::app::cli::backup {
namespace {

namespace fs = std::filesystem;

/// The folder, or the nearest one above it that exists.
fs::path existing(fs::path folder) {
  std::error_code none;
  while (!fs::exists(folder, none) && folder.has_relative_path()) folder = folder.parent_path();
  return folder;
}

/// Rounded up.
std::string mebibytes(std::uint64_t bytes) {
  return std::to_string((bytes >> 20) + ((bytes & 0xFFFFF) != 0 ? 1 : 0)) + " MiB";
}

}  // namespace

Result<> check_room(const std::vector<ManifestEvent>& events, const fs::path& folder,
                    std::uint64_t reserve) {
  if (events.empty()) return {};
  std::uint64_t wanted = reserve;
  for (const ManifestEvent& event : events) {
    if (event.bytes > std::numeric_limits<std::uint64_t>::max() - wanted) {
      return fail("is damaged: its events are too large");
    }
    wanted += event.bytes;
  }
  std::error_code error;
  const std::uintmax_t free = fs::space(existing(folder), error).available;
  if (error) return fail(folder.string() + ": " + error.message());
  if (wanted <= free) return {};
  return fail(folder.string() + ": has no room for the events: " + mebibytes(wanted) +
              " are needed, " + mebibytes(reserve) + " of them for reserve_mib, and " +
              std::to_string(free >> 20) + " MiB are free");
}

}  // namespace orbwatch::app::cli::backup
