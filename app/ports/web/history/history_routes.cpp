// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/history/history_routes.h"

#include <algorithm>
#include <string>

#include "app/ports/web/history/history_text.h"
#include "app/ports/web/query.h"

namespace orbwatch::app::web {
namespace {

constexpr std::size_t kUsualEvents = 100;
constexpr QueryArgument kEvents{"events", "Limit of entries, up to 500; default: 100"};

/// Component named by the request; nullopt: neither or both are named.
std::optional<Component> component_of(const Request& request) {
  const std::string *region = request.argument("region"), *camera = request.argument("camera");
  if (!region == !camera) return std::nullopt;
  return region ? Component{"region", *region} : Component{"camera", *camera};
}

std::string names_of(const std::vector<Component>& components) {
  std::string names;
  for (const Component& component : components) {
    names += names.empty() ? "" : ", ";
    names.append(component.kind).append("=").append(component.name);
  }
  return names;
}

}  // namespace

std::vector<Route> HistoryRoutes::routes() {
  Route figure;
  figure.method = "GET";
  figure.path = "/api/v1/history";
  figure.role = Role::Viewer;
  figure.description =
      "Returns the last ten minutes of one figure of a region or of a camera's supervision: lowest "
      "and highest value of each step, oldest first, null where it was not measured; times in s";
  figure.type = kJson;
  figure.query = {
      {"figure", "Name of the figure", true, false},
      {"region", "Name of the region; either region or camera is required", false, false},
      {"camera", "Name of the camera", false, false}};
  figure.serve = [this](const ExchangePtr& exchange) { serve_figure(exchange); };
  Route alarms = figure;
  alarms.path = "/api/v1/history/alarms";
  alarms.description =
      "Returns the events of alarms since the start, oldest first: time, value, limit, and who "
      "acknowledged";
  alarms.query = {kEvents};
  alarms.serve = [this](const ExchangePtr& exchange) { serve_alarms(exchange); };
  return {std::move(figure), std::move(alarms)};
}

void HistoryRoutes::serve_figure(const ExchangePtr& exchange) const {
  const Request& request = exchange->request();
  const auto component = component_of(request);
  const std::string* figure = request.argument("figure");
  if (!component || !figure) {
    exchange->answer(error_response(
        400, "no figure; pass ?region=NAME&figure=NAME or ?camera=NAME&figure=NAME"));
    return;
  }
  const auto series = figures_.series(*component, *figure);
  exchange->answer(
      series
          ? json_response(series_json(*series, hal::Clock::now()))
          : error_response(
                404, "unknown figure; figures of /api/v1/status that have a history belong to: " +
                         names_of(figures_.components())));
}

void HistoryRoutes::serve_alarms(const ExchangePtr& exchange) const {
  const auto most = number_of(exchange->request(), kEvents.name, kUsualEvents, 0,
                              static_cast<double>(AlarmHistory::kMost));
  if (!most) {
    exchange->answer(error_response(400, most.error().message));
    return;
  }
  const auto entries = alarms_.newest(static_cast<std::size_t>(*most));
  exchange->answer(json_response(alarm_events_json(entries, names_, recipes_)));
}

}  // namespace orbwatch::app::web
