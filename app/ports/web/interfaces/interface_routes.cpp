// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/interfaces/interface_routes.h"

#include <nlohmann/json.hpp>
#include <type_traits>
#include <utility>

#include "app/model/json.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;

Json cell_json(const InterfaceTable::Cell& cell) {
  return std::visit(
      [](const auto& value) -> Json {
        if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) {
          return to_json(value);
        } else {
          return value;
        }
      },
      cell);
}

std::string about_json(const Program& program) {
  Json versions = Json::object();
  for (const auto& [name, version] : program.versions) versions[name] = version;
  return Json{{"versions", std::move(versions)}, {"commanders", program.commanders}}.dump();
}

}  // namespace

std::string tables_json(const std::vector<InterfaceTable>& tables) {
  Json all = Json::object();
  for (const InterfaceTable& table : tables) {
    Json rows = Json::array();
    for (const auto& cells : table.rows) {
      Json row = Json::object();
      for (std::size_t i = 0; i < cells.size(); ++i) row[table.columns[i]] = cell_json(cells[i]);
      rows.push_back(std::move(row));
    }
    all[table.interface][table.name] = std::move(rows);
  }
  // Error texts of DDS may contain any bytes.
  return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::vector<Route> interface_routes(std::function<std::vector<InterfaceTable>()> tables,
                                    const Program& program) {
  std::vector<Route> routes;
  routes.push_back({"GET", "/api/v1/about", Role::Viewer,
                    "Returns the versions of the programs, and the interfaces that accept commands",
                    std::string(kJson), [about = about_json(program)](const ExchangePtr& exchange) {
                      exchange->answer(json_response(about));
                    }});
  if (!tables) return routes;
  routes.push_back({"GET", "/api/v1/interfaces", Role::Integrator,
                    "Returns Modbus registers with their values, connected clients, and DDS topics "
                    "with their readers",
                    std::string(kJson), [tables = std::move(tables)](const ExchangePtr& exchange) {
                      exchange->answer(json_response(tables_json(tables())));
                    }});
  return routes;
}

}  // namespace orbwatch::app::web
