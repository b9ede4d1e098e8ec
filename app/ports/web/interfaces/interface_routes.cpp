// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/interfaces/interface_routes.h"

#include <variant>

namespace orbwatch::app::web {

Answered<TablesAnswer> InterfaceRoutes::tables() const {
  if (!tables_) return refuse(404, "there is no other interface");
  TablesAnswer all;
  for (const InterfaceTable& table : tables_()) {
    auto& rows = all[table.interface][table.name];
    for (const auto& cells : table.rows) {
      Json row = Json::object();
      for (std::size_t i = 0; i < cells.size(); ++i) {
        row[table.columns[i]] =
            std::visit([](const auto& value) { return json_of(value); }, cells[i]);
      }
      rows.push_back(std::move(row));
    }
  }
  return all;
}

}  // namespace orbwatch::app::web
