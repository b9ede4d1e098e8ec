#pragma once

#include <string>
#include <variant>
#include <vector>

namespace orbwatch::app {

/// What an interface shows of itself to those who look after the appliance: its registers or topics
/// with their values, or who is connected.
struct InterfaceTable {
  /// A number that is not valid is NaN.
  using Cell = std::variant<std::string, double, bool>;

  std::string interface;  ///< its table in the site file: "modbus"
  std::string name;       ///< of what the rows are: "registers"
  std::vector<std::string> columns;
  std::vector<std::vector<Cell>> rows;  ///< as many cells as columns
};

}  // namespace orbwatch::app
