// SPDX-License-Identifier: Apache-2.0
#include "app/model/appliance_notice.h"

#include <arpa/inet.h>
#include <netinet/in.h>

#include <algorithm>
#include <optional>

#include "app/model/readings.h"

namespace orbwatch::app {
namespace {

std::string name_of(const AlarmStatus& alarm, std::size_t index, const StatusReport& report) {
  const std::string_view region = report.names.region(report.status.recipe, alarm.region);
  return alarm_name(index, name_or_number(region, alarm.region), alarm.signal);
}

/// The present level or the announced one, whichever is worse.
signals::AlarmLevel worst_level(const signals::Alarm& alarm) {
  return std::max(alarm.level, alarm.announced,
                  [](auto a, auto b) { return signals::severity(a) < signals::severity(b); });
}

/// Host part of a URL; nullopt: not a numeric address, or not the address of one host.
std::optional<std::string> host_of(const std::string& address) {
  in_addr v4{};
  if (inet_pton(AF_INET, address.c_str(), &v4) == 1) {
    const bool is_one =
        v4.s_addr != INADDR_ANY && !IN_MULTICAST(ntohl(v4.s_addr)) && v4.s_addr != INADDR_BROADCAST;
    return is_one ? std::optional(address) : std::nullopt;
  }
  in6_addr v6{};
  if (inet_pton(AF_INET6, address.c_str(), &v6) != 1) return std::nullopt;
  if (IN6_IS_ADDR_UNSPECIFIED(&v6) || IN6_IS_ADDR_MULTICAST(&v6)) return std::nullopt;
  return "[" + address + "]";
}

}  // namespace

std::string url_of(const PageAddress& page) {
  const auto host = host_of(page.address);
  if (!host || page.port == 0) return {};
  return "https://" + *host + ":" + std::to_string(page.port) + "/";
}

ApplianceNotice notice_of(const ApplianceIdentity& identity, const StatusReport& report) {
  const Status& status = report.status;
  ApplianceNotice notice{identity};
  notice.state = status.state;
  notice.condition = condition_of(static_cast<const SystemStatus&>(status));
  for (std::size_t i = 0; i < std::min(status.alarm_count, status.alarms.size()); ++i) {
    const AlarmStatus& alarm = status.alarms[i];
    const Severity severity = standing_severity(alarm);
    if (severity == Severity::None) continue;
    ++notice.alarms;
    if (severity <= notice.alarm.severity) continue;
    notice.alarm = {severity, name_of(alarm, i, report) + ": " +
                                  std::string(operator_text(worst_level(alarm.alarm))) + ", " +
                                  condition_of(alarm).text};
  }
  return notice;
}

}  // namespace orbwatch::app
