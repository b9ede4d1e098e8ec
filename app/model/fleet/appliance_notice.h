// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "app/model/status/condition.h"
#include "app/model/status/status_report.h"

namespace orbwatch::app {

/// Address of a page over HTTPS.
struct PageAddress {
  std::string address;  ///< numeric, IPv4 or IPv6; empty: served to its own computer only
  std::uint16_t port = 0;
};

/// "https://ADDRESS:PORT/"; empty unless the address is numeric and of one host, and there is a
/// port. Reentrant.
std::string url_of(const PageAddress& page);

/// Identity of an appliance within the site.
struct ApplianceIdentity {
  static constexpr std::size_t kLongestName = 64;  ///< bytes

  std::string name;  ///< for display; not unique
  std::string version;
  std::string prefix;  ///< prefix of its topics
  PageAddress page;
};

/// Announcement of an appliance to the others.
struct ApplianceNotice : ApplianceIdentity {
  SystemState state = SystemState::Starting;
  Condition condition{};
  std::uint32_t alarms = 0;  ///< number of active alarms
  Condition alarm{};         ///< the worst active alarm; the first of equals
};

/// Reentrant.
ApplianceNotice notice_of(const ApplianceIdentity& identity, const StatusReport& report);

}  // namespace orbwatch::app
