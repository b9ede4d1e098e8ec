// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/fleet/fleet_records.h"

#include <chrono>

#include "app/model/status/utc_text.h"

namespace orbwatch::app::web {

std::vector<SentAppliance> sent_appliances(const std::vector<Fleet::Entry>& entries,
                                           hal::TimePoint now) {
  std::vector<SentAppliance> all;
  for (const Fleet::Entry& entry : entries) {
    const ApplianceNotice& notice = entry.notice;
    const std::string page = url_of(notice.page);
    all.push_back({entry.id, notice.name, entry.is_self, entry.is_gone,
                   std::chrono::duration<double>(now - entry.newest).count(),
                   utc_text(hal::to_utc(entry.newest)), notice.state,
                   std::string(notice.condition.text), static_cast<int>(notice.condition.severity),
                   notice.alarms, std::string(notice.alarm.text),
                   static_cast<int>(notice.alarm.severity), notice.version, notice.prefix,
                   page.empty() ? std::nullopt : std::optional(page), entry.pictures});
  }
  return all;
}

}  // namespace orbwatch::app::web
