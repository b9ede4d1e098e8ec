// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/map/register_map.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "app/ports/modbus/map/rows.h"

namespace orbwatch::app::modbus {
namespace {

Row reserved(Table table, int begin, int end) {
  const bool is_bit = table == Table::Coil || table == Table::Discrete;
  return {.table = table,
          .address = begin,
          .count = end - begin,
          .type = is_bit ? Type::Bool : Type::Uint,
          .name = "reserved_" + std::string(name_of(table)) + "_" + std::to_string(begin),
          .description = "Reserved for growth; reads 0"};
}

/// Reserves every place before `end` that has no row. `rows` are those of one table.
void reserve_gaps(std::vector<Row>& rows, int end) {
  std::ranges::sort(rows, {}, &Row::address);
  const Table table = rows.front().table;
  std::vector<Row> gaps;
  int next = 0;
  for (const Row& row : rows) {
    const int until = std::min(row.address, end);
    if (until > next) gaps.push_back(reserved(table, next, until));
    next = row.address + row.count;
  }
  if (end > next) gaps.push_back(reserved(table, next, end));
  std::ranges::move(gaps, std::back_inserter(rows));
}

/// Mirror of a row for PLCs that read only coils and holding registers.
Row mirrored(Row row) {
  row.table = row.table == Table::Discrete ? Table::Coil : Table::Holding;
  row.address += kMirrorOffset;
  return row;
}

std::vector<Row> all_rows() {
  std::vector<Row> input, discrete, rows;
  add_status_rows(input);
  add_region_rows(input);
  add_discrete_rows(discrete);
  add_written_rows(rows);
  add_machine_state_rows(rows);
  reserve_gaps(rows, kMachineState.end);
  reserve_gaps(input, kResults.end);
  reserve_gaps(discrete, kUnacknowledgedBits.end);
  for (std::vector<Row>* table : {&input, &discrete}) {
    for (Row& row : *table) {
      rows.push_back(mirrored(row));
      rows.push_back(std::move(row));
    }
  }
  std::ranges::sort(rows, {}, [](const Row& row) { return std::pair(row.table, row.address); });
  return rows;
}

}  // namespace

RegisterMap::RegisterMap() : rows_(all_rows()) {
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
  constexpr std::array<std::string_view, 4> kNames{"BOOL", "UINT", "UDINT", "DINT"};
  return kNames[static_cast<std::size_t>(type)];
}

std::string_view name_of(Access access) {
  constexpr std::array<std::string_view, 2> kNames{"r", "rw"};
  return kNames[static_cast<std::size_t>(access)];
}

}  // namespace orbwatch::app::modbus
