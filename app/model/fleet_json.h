// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <vector>

#include "app/model/fleet.h"

namespace orbwatch::app {

/// A list of objects, one for each appliance; `age` is the time since its newest notice in seconds.
/// Reentrant.
nlohmann::ordered_json to_json(const std::vector<Fleet::Entry>& appliances, hal::TimePoint now);

}  // namespace orbwatch::app
