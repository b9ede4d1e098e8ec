// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string_view>
#include <vector>

#include "app/model/status/measured_recipe.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/history/alarm_history.h"
#include "app/ports/web/history/figure_history.h"
#include "app/ports/web/history/history_records.h"
#include "app/ports/web/history/kept_events.h"

namespace orbwatch::app::web {

inline constexpr std::string_view kCsv = "text/csv; charset=utf-8";

/// Keeps and serves the history of figures and of alarms, also over restarts. Thread rule: accept
/// on the pipeline's thread, advance on one thread, keep on one, everything else on any thread.
class HistoryRoutes {
 public:
  /// `state_folder` empty: nothing is kept.
  HistoryRoutes(const StatusNames& names, const std::vector<MeasuredRecipe>& recipes,
                const std::filesystem::path& state_folder);

  Answered<FigureAnswer> figure(const FigureQuery& query) const;
  /// See figure_table().
  Response table() const;
  /// AlarmsAnswer.
  Response alarms(const AlarmsQuery& query) const;

  void accept(const Status& status) { figures_.accept(status); }
  void accept(const AlarmNotice& notice) { alarms_.accept(notice); }
  void advance(hal::TimePoint now) { figures_.advance(now); }
  /// Writes new events of alarms, once in KeptEvents::kPeriod; waits for the disk.
  void keep(hal::TimePoint now);
  /// Writes everything, at the end.
  void keep_all();
  std::uint64_t alarm_events() const { return alarms_.count(); }

 private:
  std::vector<Json> events(std::size_t most) const;

  const StatusNames names_;
  const std::vector<MeasuredRecipe> recipes_;
  const std::filesystem::path figure_file_;  ///< empty: none
  FigureHistory figures_;
  AlarmHistory alarms_;
  const KeptEvents kept_;
  std::uint64_t written_ = 0;  ///< events of this process that the file has
  hal::TimePoint next_write_{};
};

}  // namespace orbwatch::app::web
