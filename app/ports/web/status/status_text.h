#pragma once

#include <string>

#include "app/model/status_report.h"
#include "app/ports/web/status/web_statistics.h"

namespace orbwatch::app::web {

/// JSON: "stamp" in UTC or null, "age" of what was last said by the pipeline in seconds, then every
/// component as app/model/json.h has it. Reentrant.
std::string status_json(const StatusReport& report, const WebStatistics& web, double age);

}  // namespace orbwatch::app::web
