// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "app/model/status/readings.h"

namespace orbwatch::app {

/// A figure of an interface itself, for metrics.
struct InterfaceMetric {
  Component component;  ///< its kind begins with the interface's table in the site file: "modbus"
  FieldInfo field;
  double value = signals::kNotValid;
};

/// Every field of a part that describes itself. Reentrant.
template <class Part>
void add_metrics(std::vector<InterfaceMetric>& all, const Component& component, const Part& part,
                 hal::TimePoint now) {
  for_each_field(std::type_identity<Part>{}, [&](const auto& field) {
    const Reading reading = reading_of(field, std::invoke(field.get, part), now);
    all.push_back({component, field, reading.value});
  });
}

}  // namespace orbwatch::app
