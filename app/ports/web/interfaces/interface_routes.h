// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/model/interface_table.h"
#include "app/model/program.h"
#include "app/ports/web/routes.h"

namespace orbwatch::app::web {

/// `{"modbus": {"registers": [{"name": ..., "value": ...}, ...]}, ...}`. Reentrant.
std::string tables_json(const std::vector<InterfaceTable>& tables);

/// Routes of the interfaces' tables, and of the program's versions. `tables` is called on any
/// thread; empty: no tables.
std::vector<Route> interface_routes(std::function<std::vector<InterfaceTable>()> tables,
                                    const Program& program);

}  // namespace orbwatch::app::web
