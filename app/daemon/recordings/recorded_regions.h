// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "app/model/sink/recorded_regions.h"
#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// The recipes of a recording with their regions in the pictures of all registered cameras that
/// the region's view has as sources. A region is where rays from the ball's centre meet it, as the
/// view shows it. Errors: those of recorded_site() and SitePlan::make(). Reentrant.
Result<std::vector<RecordedRecipe>> recorded_regions(const std::filesystem::path& recording);

}  // namespace orbwatch::app::daemon
