// SPDX-License-Identifier: Apache-2.0
#include "app/cli/state_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "app/cli/text_table.h"
#include "app/model/status/json.h"
#include "app/model/status/utc_text.h"

namespace orbwatch::app::cli {
namespace {

std::string cell(const Reading& reading) {
  if (reading.text == "true") return "yes";
  if (reading.text == "false") return "no";
  if (!reading.text.empty()) return std::string(reading.text);
  if (!signals::is_valid(reading.value)) return kNoValue;
  const bool whole = reading.value == std::floor(reading.value);
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), whole ? "%.15g" : "%.6g", reading.value);
  return reading.unit.empty() ? text.data() : text.data() + (" " + std::string(reading.unit));
}

/// Fields of a component, headed by its name.
Fields fields_of(const ComponentReadings& component) {
  Fields fields{{std::string(component.component.kind), component.component.name}};
  for (const Reading& reading : component.readings) {
    fields.emplace_back(reading.name, cell(reading));
  }
  return fields;
}

}  // namespace

std::string state_json(const ReceivedState& state) {
  using Json = nlohmann::ordered_json;
  const auto stamp = utc_text(state.stamp);
  Json all{{"stamp", stamp ? Json(*stamp) : Json()},
           {"frame_set", state.frame_set},
           {"trigger", state.trigger},
           {"result", state.result},
           {"recipe", state.recipe},
           {"configuration_checksum", state.configuration_checksum},
           {"system_state", static_cast<int>(state.system_state)},
           {"heartbeat", state.heartbeat}};
  all.update(to_json(state.components));
  return all.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string state_table(const ReceivedState& state) {
  std::string text = field_lines({{"stamp", utc_text(state.stamp).value_or(kNoValue)}});
  std::vector<std::string_view> kinds;
  for (const auto& [component, readings] : state.components) {
    if (std::ranges::find(kinds, component.kind) == kinds.end()) kinds.push_back(component.kind);
  }
  for (const std::string_view kind : kinds) {
    std::vector<Fields> records;
    for (const ComponentReadings& component : state.components) {
      if (component.component.kind == kind) records.push_back(fields_of(component));
    }
    const bool many = records.size() > records.front().size();
    text += "\n" + (many ? record_lines(records) : record_columns(records));
  }
  return text;
}

}  // namespace orbwatch::app::cli
