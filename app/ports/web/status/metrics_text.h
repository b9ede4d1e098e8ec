// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "app/model/sink/interface_metric.h"
#include "app/model/status/status_report.h"
#include "app/ports/web/status/web_statistics.h"

namespace orbwatch::app::web {

/// Prometheus' text format 0.0.4: each figure as orbwatch_KIND_FIGURE with the component's name as
/// label "name", Nan where it is not valid; including those of other interfaces; and
/// orbwatch_build_info with the label "version". Reentrant.
std::string metrics_text(const StatusReport& report, const WebStatistics& web,
                         std::span<const InterfaceMetric> interfaces, std::string_view version);

}  // namespace orbwatch::app::web
