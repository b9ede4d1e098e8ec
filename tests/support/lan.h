// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "tests/support/network_namespace.h"

namespace orbwatch::tests {

/// Computers at one Ethernet switch: a namespace each, with an interface `wire`.
class Lan {
 public:
  /// Throws like NetworkNamespace.
  explicit Lan(std::size_t computers);

  const NetworkNamespace& computer(std::size_t index) const { return *computers_[index]; }
  static std::string address(std::size_t index) { return "10.78.0." + std::to_string(index + 1); }

  /// Disconnects a computer's cable at the switch.
  void pull(std::size_t index) const { set(index, "down"); }
  void plug(std::size_t index) const { set(index, "up"); }

 private:
  void connect(std::size_t index) const;
  void set(std::size_t index, const std::string& state) const;

  NetworkNamespace switch_;
  std::vector<std::unique_ptr<NetworkNamespace>> computers_;
};

}  // namespace orbwatch::tests
