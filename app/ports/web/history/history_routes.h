// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "app/model/status/measured_recipe.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/history/alarm_history.h"
#include "app/ports/web/history/figure_history.h"
#include "app/ports/web/history/history_records.h"

namespace orbwatch::app::web {

/// Keeps and serves the history of figures and of alarms. Thread rule: accept on the pipeline's
/// thread, advance on one thread, everything else on any thread.
class HistoryRoutes {
 public:
  HistoryRoutes(const StatusNames& names, const std::vector<MeasuredRecipe>& recipes)
      : names_(names), recipes_(recipes), figures_(names) {}

  Answered<FigureAnswer> figure(const FigureQuery& query) const;
  Answered<AlarmsAnswer> alarms(const AlarmsQuery& query) const;

  void accept(const Status& status) { figures_.accept(status); }
  void accept(const AlarmNotice& notice) { alarms_.accept(notice); }
  void advance(hal::TimePoint now) { figures_.advance(now); }
  std::uint64_t alarm_events() const { return alarms_.count(); }

 private:
  const StatusNames names_;
  const std::vector<MeasuredRecipe> recipes_;
  FigureHistory figures_;
  AlarmHistory alarms_;
};

}  // namespace orbwatch::app::web
