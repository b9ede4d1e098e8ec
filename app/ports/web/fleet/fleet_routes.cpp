// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/fleet/fleet_routes.h"

namespace orbwatch::app::web {

Answered<FleetAnswer> FleetRoutes::list() const {
  if (!fleet_) return FleetAnswer{{}, 0, 0, "set enabled = true in [dds]"};
  const auto now = hal::Clock::now();
  fleet_->note_viewer(now);
  const Fleet::Counts counts = fleet_->counts();
  return FleetAnswer{sent_appliances(fleet_->list(now), now), counts.turned_away, counts.refused,
                     std::nullopt};
}

Response FleetRoutes::picture(const ThumbnailQuery& query) const {
  auto picture = fleet_ ? fleet_->picture(query.appliance) : nullptr;
  if (!picture) {
    return error_response(404,
                          "no picture of this appliance; appliance must be an id that "
                          "/api/v1/appliances lists with pictures");
  }
  return body_response(kJpeg, std::move(picture));
}

Answered<ForgottenAnswer> FleetRoutes::forget(Change<Nothing>& change) const {
  const std::size_t count = fleet_ ? fleet_->forget_gone(hal::Clock::now()) : 0;
  change.after = std::to_string(count) + " removed";
  return ForgottenAnswer{count};
}

}  // namespace orbwatch::app::web
