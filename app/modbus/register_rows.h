#pragma once

#include <vector>

#include "app/modbus/register_map.h"

namespace orbwatch::app::modbus {

/// The declaration of the map: every row, by table, then by address. Reentrant.
std::vector<Row> register_rows();

}  // namespace orbwatch::app::modbus
