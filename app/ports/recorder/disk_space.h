// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <system_error>

namespace orbwatch::app::recorder {

/// True: the disk of a folder has no room to finish a recording there. Reentrant.
inline bool is_full(const std::filesystem::path& folder) {
  constexpr std::uintmax_t kLeast = std::uintmax_t{1} << 20;
  std::error_code error;
  const std::filesystem::space_info space = std::filesystem::space(folder, error);
  return !error && space.available < kLeast;
}

}  // namespace orbwatch::app::recorder
