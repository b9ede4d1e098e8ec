#include "app/modbus/register_rows.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "app/modbus/rows/rows.h"

namespace orbwatch::app::modbus {
namespace {

/// The same value for PLCs that can read only coils and holding registers.
Row mirrored(Row row) {
  row.table = row.table == Table::Discrete ? Table::Coil : Table::Holding;
  row.address += kMirrorOffset;
  return row;
}

}  // namespace

std::vector<Row> register_rows() {
  std::vector<Row> rows;
  for (auto* block :
       {discrete_rows, system_rows, health_rows, camera_rows, view_rows, alarm_rows, region_rows}) {
    for (Row& row : block()) {
      rows.push_back(mirrored(row));
      rows.push_back(std::move(row));
    }
  }
  std::ranges::move(written_rows(), std::back_inserter(rows));
  std::ranges::sort(rows, {}, [](const Row& row) { return std::pair(row.table, row.address); });
  return rows;
}

}  // namespace orbwatch::app::modbus
