// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/map/register_table.h"

#include <cstdint>
#include <limits>

#include "app/ports/modbus/map/encoding.h"

namespace orbwatch::app::modbus {
namespace {

/// Value of a register's content, in its unit.
double value_of(Type type, double scale, std::uint32_t content) {
  if (type != Type::Dint) return content * scale;
  if (content == kNotValidCode) return std::numeric_limits<double>::quiet_NaN();
  return static_cast<std::int32_t>(content) * scale;
}

}  // namespace

InterfaceTable register_table(const RegisterMap& map, const ProcessImage& image) {
  InterfaceTable table{
      "modbus",
      "registers",
      {"table", "address", "type", "access", "name", "value", "unit", "description"},
      {}};
  for (const Row& row : map.rows()) {
    if (!row.read || is_mirror(row)) continue;
    const Quantity quantity = row.present_quantity ? row.present_quantity(image) : row.quantity;
    table.rows.push_back({std::string(name_of(row.table)), static_cast<double>(row.address),
                          std::string(name_of(row.type)), std::string(name_of(row.access)),
                          row.name, value_of(row.type, quantity.scale, row.read(image)),
                          std::string(quantity.unit), row.description});
  }
  return table;
}

}  // namespace orbwatch::app::modbus
