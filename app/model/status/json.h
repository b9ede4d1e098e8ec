// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "app/model/status/readings.h"

namespace orbwatch::app {

/// Converts a number: integral values without a fraction, as far as a double is exact; null if it
/// is not finite. Reentrant.
nlohmann::ordered_json to_json(double value);

/// Readings as one JSON object (RFC 8259): a code as its number and, in "<name>_text", its meaning;
/// a flag as a boolean; null where a value is not valid. Reentrant.
nlohmann::ordered_json to_json(std::span<const Reading> readings);

/// All components: an object for the only one of a kind ("system", "health"), for the others a list
/// of objects with a "name", under the plural of the kind ("cameras"). Reentrant.
nlohmann::ordered_json to_json(std::span<const ComponentReadings> components);

}  // namespace orbwatch::app
