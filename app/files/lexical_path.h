// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace orbwatch::app::files {

/// True for a path below the folder by its words alone: links are not followed. Reentrant.
inline bool is_lexically_below(const std::filesystem::path& file,
                               const std::filesystem::path& folder) {
  const std::filesystem::path inside = file.lexically_relative(folder);
  return !inside.empty() && *inside.begin() != "..";
}

}  // namespace orbwatch::app::files
