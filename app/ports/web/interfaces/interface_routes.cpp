// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/interfaces/interface_routes.h"

#include <variant>

namespace orbwatch::app::web {

Answered<TablesAnswer> InterfaceRoutes::tables() const {
  if (!tables_) return refuse(404, "there is no other interface");
  TablesAnswer all;
  for (const InterfaceTable& table : tables_()) {
    if (all.empty() || all.back().first != table.interface) all.push_back({table.interface, {}});
    auto& rows = all.back().second.emplace_back(table.name, std::vector<Json>()).second;
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
