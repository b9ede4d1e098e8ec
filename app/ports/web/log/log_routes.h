// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "app/ports/web/routes.h"
#include "app/recent_log.h"

namespace orbwatch::app::web {

/// Route of the newest lines of the log; none without a log.
std::vector<Route> log_routes(std::shared_ptr<const RecentLog> log);

}  // namespace orbwatch::app::web
