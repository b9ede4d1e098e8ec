// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "app/daemon/site/site_plan.h"
#include "app/files/resolve.h"

namespace orbwatch::app::daemon {

/// Decisions of the plan where rig and recipes state nothing, in words that name the file: cameras
/// that are left out, and limits of hot spots, by region and key, for the plan's formats. Empty:
/// all is stated. Reentrant.
std::vector<std::string> assumptions(const files::Resolved& site, const SitePlan& plan);

}  // namespace orbwatch::app::daemon
