#include "app/modbus/register_map.h"

#include <array>

#include "app/modbus/register_rows.h"

namespace orbwatch::app::modbus {

RegisterMap::RegisterMap() : rows_(register_rows()) {
  for (const Row& row : rows_) {
    auto& addresses = by_address_[static_cast<std::size_t>(row.table)];
    addresses.resize(static_cast<std::size_t>(row.address), nullptr);
    addresses.resize(addresses.size() + static_cast<std::size_t>(row.count), &row);
  }
}

const Row* RegisterMap::find(Table table, int address) const {
  const auto& addresses = by_address_[static_cast<std::size_t>(table)];
  const auto place = static_cast<std::size_t>(address);
  return place < addresses.size() ? addresses[place] : nullptr;
}

int RegisterMap::size(Table table) const {
  return static_cast<int>(by_address_[static_cast<std::size_t>(table)].size());
}

std::string_view name_of(Table table) {
  constexpr std::array<std::string_view, 4> kNames{"coil", "discrete", "input", "holding"};
  return kNames[static_cast<std::size_t>(table)];
}

std::string_view name_of(Type type) {
  constexpr std::array<std::string_view, 4> kNames{"bool", "u16", "u32", "i32"};
  return kNames[static_cast<std::size_t>(type)];
}

std::string_view name_of(Access access) {
  constexpr std::array<std::string_view, 2> kNames{"r", "rw"};
  return kNames[static_cast<std::size_t>(access)];
}

}  // namespace orbwatch::app::modbus
