#pragma once

#include <span>
#include <string>
#include <string_view>

#include "app/model/interface_metric.h"
#include "app/model/status_report.h"
#include "app/ports/web/status/web_statistics.h"

/// A status as text for other programs, from the model's descriptions alone. All reentrant.
namespace orbwatch::app::web {

/// JSON: "stamp" in UTC or null, "age" of what was last said by the pipeline in seconds, then every
/// component as app/model/json.h has it.
std::string status_json(const StatusReport& report, const WebStatistics& web, double age);

/// Prometheus' text format 0.0.4: each figure as orbwatch_KIND_FIGURE with the component's name as
/// label "name", NaN where it is not valid; those of other interfaces, too; and orbwatch_build_info
/// with the label "version".
std::string metrics_text(const StatusReport& report, const WebStatistics& web,
                         std::span<const InterfaceMetric> interfaces, std::string_view version);

}  // namespace orbwatch::app::web
