// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/status/status_schema.h"

#include <type_traits>
#include <utility>

#include "app/model/status/readings.h"
#include "app/ports/web/api/record_schema.h"
#include "app/ports/web/status/web_statistics.h"

namespace orbwatch::app::web {
namespace {

/// Schema of an object that always has all of these members.
Json object_schema(Json properties) {
  Json names = Json::array();
  for (const auto& member : properties.items()) names.push_back(member.key());
  return {{"type", "object"},
          {"properties", std::move(properties)},
          {"additionalProperties", false},
          {"required", std::move(names)}};
}

/// Schema of a field in the form of app/model/status/json.cpp.
template <class Value>
Json figure_schema(const FieldInfo& field) {
  Json figure;
  if constexpr (std::is_enum_v<Value>) {
    figure = code_schema<Value>();
  } else if constexpr (std::is_same_v<Value, bool>) {
    figure = {{"type", "boolean"}};
  } else if constexpr (std::is_same_v<Value, PartName>) {
    figure = {{"type", "string"}, {"nullable", true}};
  } else {
    figure = {{"type", "number"}, {"nullable", true}};
  }
  if (!field.title.empty()) figure["title"] = field.title;
  figure["description"] = field.description;
  if (!field.unit.empty()) figure["x-unit"] = field.unit;
  return figure;
}

template <class Part>
Json part_schema(bool is_named) {
  Json properties = Json::object();
  if (is_named) properties["name"] = {{"type", "string"}, {"description", "Its name"}};
  for_each_field(std::type_identity<Part>{}, [&](const auto& field) {
    using Value = std::decay_t<decltype(std::invoke(field.get, std::declval<const Part&>()))>;
    const std::string name(field.name);
    properties[name] = figure_schema<Value>(field);
    if constexpr (std::is_enum_v<Value>) {
      properties[name + "_text"] = {{"type", "string"}, {"description", "The code as text"}};
    }
  });
  return object_schema(std::move(properties));
}

}  // namespace

Json status_schema() {
  Status one_of_each;
  one_of_each.region_count = one_of_each.alarm_count = 1;
  one_of_each.camera_count = one_of_each.view_count = 1;
  one_of_each.machine.quality = MachineQuality::Good;
  const StatusNames no_names;
  Json all = object_schema(
      {{"stamp",
        {{"type", "string"},
         {"format", "date-time"},
         {"nullable", true},
         {"description", "Exposure start of the newest frame set, UTC; null: none yet"}}},
       {"age",
        {{"type", "number"},
         {"nullable", true},
         {"description", "Time since the pipeline's report"},
         {"x-unit", "s"}}}});
  Json& properties = all["properties"];
  const auto add = [&](const Component& component, const auto& part) {
    const bool is_named = !component.name.empty();
    const std::string kind(component.kind);
    Json schema = part_schema<std::decay_t<decltype(part)>>(is_named);
    if (is_named) {
      // A list without entries is not sent.
      properties[kind + "s"] = list_schema(std::move(schema));
      properties[kind + "s"]["description"] = "Figures of each " + kind;
    } else {
      // Sent only where machine states are configured.
      if (kind != "machine") all["required"].push_back(kind);
      properties[kind] = std::move(schema);
      properties[kind]["description"] = "Figures of the " + kind;
    }
  };
  for_each_component(StatusReport{one_of_each, no_names, hal::TimePoint{}, {}}, add);
  add(kWebComponent, WebStatistics{});
  return all;
}

}  // namespace orbwatch::app::web
