#pragma once

#include <vector>

#include "app/modbus/register_map.h"

namespace orbwatch::app::modbus {

/// The rows of each block, by address; without mirrors. All reentrant.
std::vector<Row> discrete_rows();
std::vector<Row> system_rows();
std::vector<Row> health_rows();
std::vector<Row> camera_rows();
std::vector<Row> view_rows();
std::vector<Row> alarm_rows();
std::vector<Row> region_rows();
std::vector<Row> written_rows();

}  // namespace orbwatch::app::modbus
