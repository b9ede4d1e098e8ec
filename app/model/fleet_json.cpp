// SPDX-License-Identifier: Apache-2.0
#include "app/model/fleet_json.h"

#include <chrono>

#include "app/model/json.h"
#include "app/model/utc_text.h"

namespace orbwatch::app {
namespace {

using Json = nlohmann::ordered_json;

Json entry_json(const Fleet::Entry& entry, hal::TimePoint now) {
  const ApplianceNotice& notice = entry.notice;
  const std::string page = url_of(notice.page);
  const auto newest = utc_text(hal::to_utc(entry.newest));
  return {{"id", entry.id},
          {"name", notice.name},
          {"is_self", entry.is_self},
          {"is_gone", entry.is_gone},
          {"age", to_json(std::chrono::duration<double>(now - entry.newest).count())},
          {"newest", newest ? Json(*newest) : Json()},
          {"state", static_cast<int>(notice.state)},
          {"state_text", operator_text(notice.state)},
          {"condition", notice.condition.text},
          {"severity", static_cast<int>(notice.condition.severity)},
          {"alarms", notice.alarms},
          {"alarm", notice.alarm.text},
          {"alarm_severity", static_cast<int>(notice.alarm.severity)},
          {"version", notice.version},
          {"prefix", notice.prefix},
          {"page", page.empty() ? Json() : Json(page)},
          {"pictures", entry.pictures}};
}

}  // namespace

nlohmann::ordered_json to_json(const std::vector<Fleet::Entry>& appliances, hal::TimePoint now) {
  Json list = Json::array();
  for (const Fleet::Entry& entry : appliances) list.push_back(entry_json(entry, now));
  return list;
}

}  // namespace orbwatch::app
