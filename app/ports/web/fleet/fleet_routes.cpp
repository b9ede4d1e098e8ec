// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/fleet/fleet_routes.h"

#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "app/model/fleet_json.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kMissing = "set enabled = true in [dds]";

void show(Fleet* fleet, const ExchangePtr& exchange) {
  const auto now = hal::Clock::now();
  if (fleet) fleet->look(now);
  exchange->answer(json_response(fleet_json(fleet, now)));
}

void show_picture(const Fleet* fleet, const ExchangePtr& exchange) {
  const std::string* id = exchange->request().argument("appliance");
  auto picture = fleet && id ? fleet->picture(*id) : nullptr;
  if (!picture) {
    exchange->answer(error_response(404,
                                    "unknown appliance; pass ?appliance=ID with an id that "
                                    "/api/v1/appliances lists with pictures"));
    return;
  }
  Response response;
  response.type = kJpeg;
  response.body = std::move(picture);
  exchange->answer(std::move(response));
}

void forget(Fleet* fleet, const ExchangePtr& exchange) {
  const std::size_t count = fleet ? fleet->forget_gone(hal::Clock::now()) : 0;
  exchange->answer(json_response(Json{{"forgotten", count}}.dump()));
}

}  // namespace

std::string fleet_json(Fleet* fleet, hal::TimePoint now) {
  const Fleet::Counts counts = fleet ? fleet->counts() : Fleet::Counts{};
  return Json{{"appliances", to_json(fleet ? fleet->list(now) : std::vector<Fleet::Entry>(), now)},
              {"turned_away", counts.turned_away},
              {"refused", counts.refused},
              {"missing", fleet ? Json() : Json(kMissing)}}
      .dump();
}

std::vector<Route> fleet_routes(const std::shared_ptr<Fleet>& fleet) {
  const auto by = [&fleet](auto serve) {
    return [fleet, serve](const ExchangePtr& exchange) { serve(fleet.get(), exchange); };
  };
  std::vector<Route> routes;
  routes.push_back({"GET", "/api/v1/appliances", Role::Viewer,
                    "Returns all appliances of the DDS domain, including those that left: state, "
                    "page, and the time since their last message in seconds",
                    std::string(kJson), by(show)});
  routes.push_back({"GET", "/api/v1/appliances/picture.jpg", Role::Viewer,
                    "Returns a thumbnail of an appliance of the domain, updated every few seconds "
                    "while the list is requested",
                    std::string(kJpeg), by(show_picture)});
  routes.back().query = {{"appliance", "Id of the appliance in the list", true, false}};
  routes.push_back({"POST", "/api/v1/forget_appliances", Role::Operator,
                    "Removes appliances that left from the list", std::string(kJson), by(forget)});
  return routes;
}

}  // namespace orbwatch::app::web
