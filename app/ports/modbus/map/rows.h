#pragma once

#include <vector>

#include "app/ports/modbus/map/register_map.h"

namespace orbwatch::app::modbus {

/// The rows of each block, without mirrors and reserved places. All reentrant.
std::vector<Row> discrete_rows();
std::vector<Row> status_rows();  ///< all input registers but alarms and regions
std::vector<Row> alarm_rows();
std::vector<Row> region_rows();
std::vector<Row> written_rows();

}  // namespace orbwatch::app::modbus
