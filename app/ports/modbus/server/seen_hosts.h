// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "app/ports/modbus/server/access_list.h"

namespace orbwatch::app::modbus {

/// Hosts already seen, so that each is reported once. The size is bounded: beyond it no host counts
/// as new. Thread-bound.
class SeenHosts {
 public:
  static constexpr std::size_t kMost = 64;

  /// Returns true once for each host.
  bool is_new(const HostAddress& host) {
    if (hosts_.size() == kMost || std::ranges::count(hosts_, host) != 0) return false;
    hosts_.push_back(host);
    return true;
  }

 private:
  std::vector<HostAddress> hosts_;
};

}  // namespace orbwatch::app::modbus
