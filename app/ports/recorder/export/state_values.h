// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <string>

#include "app/model/csv_text.h"
#include "app/ports/recorder/messages.h"

/// Signals of the regions and state of the machine in a recorded state. All reentrant.
namespace orbwatch::app::recorder {

/// Calls `visit(title, figure)` for each value; titles are region.NAME.FIGURE and machine.FIGURE.
template <class Visit>
void for_each_value(const ProcessState& state, Visit&& visit) {
  for (const ComponentFigures& component : state.components) {
    if (component.kind != "region" && component.kind != "machine") continue;
    const std::string front =
        component.name.empty() ? component.kind : component.kind + "." + component.name;
    for (const Figure& figure : component.figures) visit(front + "." + figure.name, figure);
  }
}

/// A number, or a text without one, such as the name of the part; empty: not valid.
inline std::string value_text(const Figure& figure) {
  return std::isnan(figure.value) ? figure.text : csv_number(figure.value);
}

}  // namespace orbwatch::app::recorder
