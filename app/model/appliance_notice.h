#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "app/model/condition.h"
#include "app/model/status_report.h"

namespace orbwatch::app {

/// Of a page over HTTPS.
struct PageAddress {
  std::string address;  ///< numeric, IPv4 or IPv6; empty: it is there for its own computer only
  std::uint16_t port = 0;
};

/// "https://ADDRESS:PORT/"; empty unless the address is numeric, of one computer, and there is a
/// port. Reentrant.
std::string url_of(const PageAddress& page);

/// Which appliance of the site it is, and where.
struct ApplianceIdentity {
  static constexpr std::size_t kLongestName = 64;  ///< bytes

  std::string name;  ///< for people; several may have the same
  std::string version;
  std::string prefix;  ///< of its topics
  PageAddress page;
};

/// What an appliance says of itself to the others.
struct ApplianceNotice : ApplianceIdentity {
  SystemState state = SystemState::Starting;
  Condition condition{};
  std::uint32_t alarms = 0;  ///< that stand
  Condition alarm{};         ///< the worst of them, the first one of several
};

/// Reentrant.
ApplianceNotice notice_of(const ApplianceIdentity& identity, const StatusReport& report);

}  // namespace orbwatch::app
