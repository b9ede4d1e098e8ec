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

/// Bytes of the files in a folder; those that vanish meanwhile do not count. Reentrant.
inline std::uint64_t bytes_in(const std::filesystem::path& folder) {
  std::uint64_t bytes = 0;
  std::error_code error;
  for (std::filesystem::directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    std::error_code vanished;
    const std::uint64_t size = it->file_size(vanished);
    if (!vanished) bytes += size;
  }
  return bytes;
}

}  // namespace orbwatch::app::recorder
