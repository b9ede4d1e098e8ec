// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "app/model/fleet.h"
#include "app/ports/web/routes.h"

namespace orbwatch::app::web {

/// `{"appliances": [{"id": ..., "name": ..., "page": ...}, ...], "turned_away": 0, "refused": 0,
/// "missing": null}`. `fleet` null: `missing` states that DDS is needed. Reentrant.
std::string fleet_json(Fleet* fleet, hal::TimePoint now);

/// The routes of all appliances of the DDS domain. `fleet` null: DDS is not enabled.
std::vector<Route> fleet_routes(const std::shared_ptr<Fleet>& fleet);

}  // namespace orbwatch::app::web
