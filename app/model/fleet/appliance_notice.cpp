// SPDX-License-Identifier: Apache-2.0
#include "app/model/fleet/appliance_notice.h"

#include <algorithm>
#include <optional>

#include "app/model/status/readings.h"
#include "hal/network.h"

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
  static const auto kNotOne =
      hal::parse_networks({"0.0.0.0", "224.0.0.0/4", "255.255.255.255", "::", "ff00::/8"}).value();
  const auto host = hal::parse_host(address);
  if (!host || hal::any_contains(kNotOne, *host)) return std::nullopt;
  return address.find(':') == address.npos ? address : "[" + address + "]";
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
