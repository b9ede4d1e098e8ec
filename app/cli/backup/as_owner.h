// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>

#include "proc/image/result.h"

namespace orbwatch::app::cli::backup {

/// Calls `act` with the rights of the owner of a folder alone: if this process is root and the
/// owner is not, in a process of that user and group, so that links of the owner lead root nowhere.
/// Open files stay open. Errors: those of `act`; the process. Not while other threads run.
Result<> as_owner_of(const std::filesystem::path& folder, const std::function<Result<>()>& act);

}  // namespace orbwatch::app::cli::backup
