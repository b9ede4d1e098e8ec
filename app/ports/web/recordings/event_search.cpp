// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/recordings/event_search.h"

#include <algorithm>
#include <chrono>
#include <ranges>

namespace orbwatch::app::web {
namespace {

char lower(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

bool contains(std::string_view text, std::string_view part) {
  const auto found = std::ranges::search(text, part, {}, lower, lower);
  return part.empty() || !found.empty();
}

/// UTC as events have it, whose texts are in the order of time; empty remains empty.
std::string written_in_full(const std::string& moment) {
  const auto nanoseconds = parse_utc_text(moment);
  if (!nanoseconds) return {};
  return utc_text(std::chrono::system_clock::time_point(std::chrono::nanoseconds(*nanoseconds)))
      .value_or("");
}

}  // namespace

RecordingsAnswer search_events(const std::vector<RecordedEvent>& events,
                               const RecordingsQuery& query) {
  const std::string from = written_in_full(query.from), to = written_in_full(query.to);
  const auto matches = [&](const RecordedEvent& event) {
    const std::string& moment = event.triggered.empty() ? event.first : event.triggered;
    return (query.trigger.empty() || event.trigger == query.trigger) &&
           contains(event.part, query.part) && (!query.layer || event.layer == *query.layer) &&
           (from.empty() || moment >= from) && (to.empty() || (!moment.empty() && moment <= to));
  };
  RecordingsAnswer answer;
  answer.total = events.size();
  for (const RecordedEvent& event : events | std::views::reverse) {
    if (!matches(event)) continue;
    ++answer.matching;
    if (!query.before.empty() && event.name >= query.before) continue;
    answer.has_older = answer.events.size() == static_cast<std::size_t>(query.limit);
    if (!answer.has_older) answer.events.push_back(event);
  }
  return answer;
}

}  // namespace orbwatch::app::web
