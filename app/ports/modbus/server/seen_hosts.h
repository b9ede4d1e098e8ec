#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "app/ports/modbus/server/access_list.h"

namespace orbwatch::app::modbus {

/// Hosts that were seen, so that each is reported once. Of bounded size: beyond it none is new.
/// Thread-bound.
class SeenHosts {
 public:
  static constexpr std::size_t kMost = 64;

  /// True once for a host.
  bool is_new(const HostAddress& host) {
    if (hosts_.size() == kMost || std::ranges::count(hosts_, host) != 0) return false;
    hosts_.push_back(host);
    return true;
  }

 private:
  std::vector<HostAddress> hosts_;
};

}  // namespace orbwatch::app::modbus
