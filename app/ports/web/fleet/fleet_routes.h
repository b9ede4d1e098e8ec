// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <utility>

#include "app/ports/web/api/changes.h"
#include "app/ports/web/api/record.h"
#include "app/ports/web/api/route.h"
#include "app/ports/web/fleet/fleet_records.h"

namespace orbwatch::app::web {

/// Serves the list of the appliances of the DDS domain. Thread-safe.
class FleetRoutes {
 public:
  /// `fleet` null: DDS is not enabled.
  explicit FleetRoutes(std::shared_ptr<Fleet> fleet) : fleet_(std::move(fleet)) {}

  Answered<FleetAnswer> list() const;
  Response picture(const ThumbnailQuery& query) const;
  Answered<ForgottenAnswer> forget(Change<Nothing>& change) const;

 private:
  const std::shared_ptr<Fleet> fleet_;
};

}  // namespace orbwatch::app::web
