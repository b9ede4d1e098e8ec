// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/history/history_routes.h"

#include <string>

namespace orbwatch::app::web {
namespace {

std::string names_of(const std::vector<Component>& components) {
  std::string names;
  for (const Component& component : components) {
    names += names.empty() ? "" : ", ";
    names.append(component.kind).append("=").append(component.name);
  }
  return names;
}

}  // namespace

Answered<FigureAnswer> HistoryRoutes::figure(const FigureQuery& query) const {
  const Component component =
      query.region.empty() ? Component{"camera", query.camera} : Component{"region", query.region};
  const auto series = figures_.series(component, query.figure);
  if (series) return figure_answer(*series, hal::Clock::now());
  return refuse(404, "unknown figure; figures of /api/v1/status that have a history belong to: " +
                         names_of(figures_.components()));
}

Answered<AlarmsAnswer> HistoryRoutes::alarms(const AlarmsQuery& query) const {
  AlarmsAnswer answer;
  for (const AlarmHistory::Entry& entry : alarms_.newest(query.events)) {
    answer.alarms.push_back(sent_event(entry, names_, recipes_));
  }
  return answer;
}

}  // namespace orbwatch::app::web
