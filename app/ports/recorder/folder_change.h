// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <system_error>

namespace orbwatch::app::recorder {

/// Time at which names in a folder last changed: as long as it is the same, the folder has the same
/// names. nullopt: it must be read again, because a further change may get the same time (clocks of
/// file systems tick up to 2 s apart), because the clock was set back, or because it is not there.
/// Reentrant.
inline std::optional<std::filesystem::file_time_type> settled_change(
    const std::filesystem::path& folder) {
  constexpr std::chrono::seconds kLongestTick{2};
  const auto now = std::filesystem::file_time_type::clock::now();
  std::error_code error;
  const auto changed = std::filesystem::last_write_time(folder, error);
  if (error || now - changed < kLongestTick) return std::nullopt;
  return changed;
}

}  // namespace orbwatch::app::recorder
