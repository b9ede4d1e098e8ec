// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "app/model/status_report.h"
#include "app/ports/web/status/web_statistics.h"

namespace orbwatch::app::web {

/// Status as JSON: "stamp" in UTC or null, "age" of the pipeline's last report in seconds, then
/// every component in the form of app/model/json.h. Reentrant.
std::string status_json(const StatusReport& report, const WebStatistics& web, double age);

}  // namespace orbwatch::app::web
