// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/ports/lines/line_settings.h"
#include "proc/image/result.h"

namespace orbwatch::app::files {

/// Records the GPIO outputs among `lines` in `folder`, runtime_directory() or else the state
/// folder: after SIGKILL they are set inactive, independent of the files at that time. Error: as
/// hal::write_file(); the previous record is then lost, too. Reentrant.
Result<> record_driven_lines(const std::filesystem::path& folder,
                             const std::vector<LineSettings>& lines);

/// Outputs that were driven last since the board's start; nullopt: none are recorded. Error: the
/// record cannot be read. Reentrant.
Result<std::optional<std::vector<LineSettings>>> driven_lines(const std::filesystem::path& folder);

/// Removes the record, because the outputs are inactive. Reentrant.
void forget_driven_lines(const std::filesystem::path& folder);

}  // namespace orbwatch::app::files
