// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <variant>
#include <vector>

namespace orbwatch::app {

/// Table of an interface's own state, for maintenance: its registers or topics with their values,
/// or its clients.
struct InterfaceTable {
  /// A number that is not valid is NaN.
  using Cell = std::variant<std::string, double, bool>;

  std::string interface;  ///< its table in the site file: "modbus"
  std::string name;       ///< kind of the rows: "registers"
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;  ///< one cell per column
};

}  // namespace orbwatch::app
