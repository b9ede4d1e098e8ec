// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/recordings/event_search.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string_view>

namespace orbwatch::app::web {
namespace {

char lower(char letter) {
  return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

bool contains(std::string_view text, std::string_view part) {
  const auto is_same = [](char one, char other) { return lower(one) == lower(other); };
  return part.empty() ||
         std::search(text.begin(), text.end(), part.begin(), part.end(), is_same) != text.end();
}

/// Time of the trigger, or of the first frame set; nullopt: not known.
std::optional<std::uint64_t> moment_of(const RecordedEvent& event) {
  return parse_utc_text(event.triggered.empty() ? event.first : event.triggered);
}

}  // namespace

RecordingsAnswer search_events(const std::vector<RecordedEvent>& events,
                               const RecordingsQuery& query) {
  const auto from = parse_utc_text(query.from), to = parse_utc_text(query.to);
  const auto is_in_range = [&](const RecordedEvent& event) {
    if (!from && !to) return true;
    const auto moment = moment_of(event);
    return moment && (!from || *moment >= *from) && (!to || *moment <= *to);
  };
  const auto matches = [&](const RecordedEvent& event) {
    return (query.trigger.empty() || event.trigger == query.trigger) &&
           contains(event.part, query.part) && (!query.layer || event.layer == *query.layer) &&
           is_in_range(event);
  };
  RecordingsAnswer answer;
  answer.total = events.size();
  for (auto at = events.rbegin(); at != events.rend(); ++at) {
    const RecordedEvent& event = *at;
    if (!matches(event)) continue;
    ++answer.matching;
    if (!query.before.empty() && event.name >= query.before) continue;
    answer.has_older = answer.events.size() == static_cast<std::size_t>(query.limit);
    if (!answer.has_older) answer.events.push_back(event);
  }
  return answer;
}

}  // namespace orbwatch::app::web
