// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "app/cli/backup/manifest.h"
#include "proc/image/result.h"

namespace orbwatch::app::cli::backup {

/// Error: the disk of a folder has no room for as many bytes as events have, and for a reserve.
Result<> check_room(const std::vector<ManifestEvent>& events, const std::filesystem::path& folder,
                    std::uint64_t reserve);

}  // namespace orbwatch::app::cli::backup
