// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "app/ports/modbus/map/register_map.h"

namespace orbwatch::app::modbus {

/// Functions that append the rows of each block, without mirrors and reserved places. All
/// reentrant.
void add_discrete_rows(std::vector<Row>& rows);
void add_status_rows(std::vector<Row>& rows);  ///< all input registers except regions
void add_region_rows(std::vector<Row>& rows);
void add_written_rows(std::vector<Row>& rows);
void add_machine_state_rows(std::vector<Row>& rows);

}  // namespace orbwatch::app::modbus
