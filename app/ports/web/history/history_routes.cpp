// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/history/history_routes.h"

#include <algorithm>
#include <string>

#include "app/log.h"
#include "app/ports/web/api/record.h"
#include "app/ports/web/history/figure_file.h"
#include "app/ports/web/history/figure_table.h"

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

std::filesystem::path file_in(const std::filesystem::path& folder, const char* name) {
  return folder.empty() ? std::filesystem::path() : folder / name;
}

}  // namespace

HistoryRoutes::HistoryRoutes(const StatusNames& names, const std::vector<MeasuredRecipe>& recipes,
                             const std::filesystem::path& state_folder)
    : names_(names),
      recipes_(recipes),
      figure_file_(file_in(state_folder, "figure-history")),
      figures_(names),
      kept_(file_in(state_folder, "alarm-history.json")) {
  if (figure_file_.empty()) return;
  if (const auto resumed = resume_figures(figure_file_, figures_); !resumed) {
    log_line(LogLevel::Warning, "no figures before this start: " + resumed.error().message);
  }
}

Answered<FigureAnswer> HistoryRoutes::figure(const FigureQuery& query) const {
  const Component component =
      query.region.empty() ? Component{"camera", query.camera} : Component{"region", query.region};
  const auto series = figures_.series(component, query.figure);
  if (series) return figure_answer(*series, hal::Clock::now());
  return refuse(404, "unknown figure; figures of /api/v1/status that have a history belong to: " +
                         names_of(figures_.components()));
}

Response HistoryRoutes::table() const { return body_response(kCsv, figure_table(figures_)); }

Response HistoryRoutes::alarms(const AlarmsQuery& query) const {
  return json_response(json_text({{"alarms", events(query.events)}}));
}

/// The newest events, oldest first; numbers continue those of processes before.
std::vector<Json> HistoryRoutes::events(std::size_t most) const {
  std::vector<Json> all = kept_.before();
  for (const AlarmHistory::Entry& entry : alarms_.newest(most)) {
    SentAlarmEvent sent = sent_event(entry, names_, recipes_);
    sent.notice.number += kept_.newest_number();
    all.push_back(json_of(sent));
  }
  all.erase(all.begin(), all.end() - static_cast<std::ptrdiff_t>(std::min(most, all.size())));
  return all;
}

void HistoryRoutes::keep(hal::TimePoint now) {
  const std::uint64_t count = alarms_.count();
  if (count == written_ || now < next_write_) return;
  kept_.write(events(AlarmHistory::kMost));
  written_ = count;
  next_write_ = now + KeptEvents::kPeriod;
}

void HistoryRoutes::keep_all() {
  next_write_ = {};
  keep(hal::Clock::now());
  if (figure_file_.empty()) return;
  if (const auto written = write_figures(figure_file_, figures_); !written) {
    log_line(LogLevel::Warning, "the history of figures is not kept: " + written.error().message);
  }
}

}  // namespace orbwatch::app::web
