#pragma once

#include <nlohmann/json.hpp>
#include <span>

#include "app/model/readings.h"

namespace orbwatch::app {

/// A whole number without a fraction, as far as a double counts; null where it is not finite.
/// Reentrant.
nlohmann::ordered_json to_json(double value);

/// Readings as one JSON object (RFC 8259): of a code its number and, as "<name>_text", its meaning;
/// of a flag a truth; null where a value is not valid. Reentrant.
nlohmann::ordered_json to_json(std::span<const Reading> readings);

/// All components: an object for the only one of a kind ("system", "health"), under the plural of
/// the kind a list of objects with a "name" for the others ("cameras"). Reentrant.
nlohmann::ordered_json to_json(std::span<const ComponentReadings> components);

}  // namespace orbwatch::app
