// SPDX-License-Identifier: Apache-2.0
#include "app/model/status/json.h"

#include <cmath>
#include <cstdint>

namespace orbwatch::app {
namespace {

using Json = nlohmann::ordered_json;

void add(Json& object, const Reading& reading) {
  const std::string name(reading.name);
  if (reading.text == "true" || reading.text == "false") {
    object[name] = reading.text == "true";
    return;
  }
  if (is_text(reading)) {
    object[name] = reading.text;
    return;
  }
  object[name] = to_json(reading.value);
  if (!reading.text.empty()) object[name + "_text"] = reading.text;
}

}  // namespace

Json to_json(double value) {
  constexpr double kExact = 9007199254740992;  // 2^53
  if (!std::isfinite(value)) return nullptr;
  if (value == std::floor(value) && std::abs(value) <= kExact) {
    return static_cast<std::int64_t>(value);
  }
  return value;
}

Json to_json(std::span<const Reading> readings) {
  Json object = Json::object();
  for (const Reading& reading : readings) add(object, reading);
  return object;
}

Json to_json(std::span<const ComponentReadings> components) {
  Json all = Json::object();
  for (const auto& [component, readings] : components) {
    const std::string kind(component.kind);
    if (component.name.empty()) {
      all[kind] = to_json(readings);
      continue;
    }
    Json entry{{"name", component.name}};
    entry.update(to_json(readings));
    Json& entries = all[kind + "s"];
    if (!entries.is_array()) entries = Json::array();
    entries.push_back(std::move(entry));
  }
  return all;
}

}  // namespace orbwatch::app
