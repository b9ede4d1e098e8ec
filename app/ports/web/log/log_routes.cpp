// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/log/log_routes.h"

#include <algorithm>

#include "app/model/status/utc_text.h"

namespace orbwatch::app::web {
namespace {

SentLine sent_line(const RecentLog::Line& line) {
  SentLine sent{line.number, utc_text(line.time).value_or(""), line.level, line.text, {}, {}, {}};
  if (!line.camera.empty()) sent.camera = line.camera;
  if (!line.fault.empty()) sent.fault = line.fault;
  if (line.trigger != 0) sent.trigger = line.trigger;
  return sent;
}

}  // namespace

Answered<LogAnswer> LogRoutes::lines(const LogQuery& query) const {
  if (!log_) return refuse(404, "this program keeps no lines of its log");
  // Read before the lines, so that no line added meanwhile is skipped.
  LogAnswer answer{utc_text(log_->started()).value_or(""), log_->newest_number(), {}};
  for (const RecentLog::Line& line : log_->newest(query.wanted)) {
    answer.lines.push_back(sent_line(line));
    answer.newest = std::max(answer.newest, line.number);
  }
  return answer;
}

}  // namespace orbwatch::app::web
