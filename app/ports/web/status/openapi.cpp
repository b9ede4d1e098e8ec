// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/status/openapi.h"

#include <nlohmann/json.hpp>
#include <type_traits>

#include "app/model/readings.h"
#include "app/ports/web/status/web_statistics.h"

namespace orbwatch::app::web {
namespace {

using Json = nlohmann::ordered_json;

std::string with_unit(std::string_view description, std::string_view unit) {
  return std::string(description) + (unit.empty() ? "" : ", " + std::string(unit));
}

/// Schema of a field in the form of app/model/json.cpp.
template <class Value>
void add_figure(Json& properties, const FieldInfo& field) {
  const std::string name(field.name);
  Json& figure = properties[name];
  figure["description"] = with_unit(field.description, field.unit);
  if (!std::string_view(field.unit).empty()) figure["x-unit"] = field.unit;
  if constexpr (std::is_same_v<Value, bool>) {
    figure["type"] = "boolean";
  } else {
    figure["type"] = "number";
    figure["nullable"] = true;
  }
  if constexpr (std::is_enum_v<Value>) {
    properties[name + "_text"] = {{"type", "string"}, {"description", "The code as text"}};
  }
}

template <class Part>
Json schema_of(const Part& part, bool is_named) {
  Json properties = Json::object();
  if (is_named) properties["name"] = {{"type", "string"}};
  for_each_field(std::type_identity<Part>{}, [&](const auto& field) {
    add_figure<std::decay_t<decltype(std::invoke(field.get, part))>>(properties, field);
  });
  return {{"type", "object"}, {"properties", std::move(properties)}};
}

/// Schema from a status with one component of each kind.
Json status_schema() {
  Status one_of_each;
  one_of_each.region_count = one_of_each.alarm_count = 1;
  one_of_each.camera_count = one_of_each.view_count = 1;
  const StatusNames no_names;
  Json properties{{"stamp", {{"type", "string"}, {"format", "date-time"}, {"nullable", true}}},
                  {"age",
                   {{"type", "number"},
                    {"nullable", true},
                    {"description", "Time since the pipeline's report, s"}}}};
  for_each_component(StatusReport{one_of_each, no_names, hal::TimePoint{}, {}},
                     [&](const Component& component, const auto& part) {
                       const std::string kind(component.kind);
                       const bool is_named = !component.name.empty();
                       Json schema = schema_of(part, is_named);
                       if (!is_named) {
                         properties[kind] = std::move(schema);
                       } else {
                         Json& list = properties[kind + "s"];
                         list["type"] = "array";
                         list["items"] = std::move(schema);
                       }
                     });
  properties[std::string(kWebComponent.kind)] = schema_of(WebStatistics{}, false);
  return {{"type", "object"}, {"properties", std::move(properties)}};
}

Json command_schema(const CommandInfo& info) {
  Json properties = Json::object(), names = Json::array();
  for (std::size_t i = 0; i < info.argument_count(); ++i) {
    const ArgumentInfo& argument = info.arguments[i];
    const std::string name(argument.name);
    properties[name] = {{"type", argument.scale == 1 ? "integer" : "number"},
                        {"minimum", argument.minimum},
                        {"maximum", argument.maximum},
                        {"description", with_unit(argument.description, argument.unit)}};
    names.push_back(name);
  }
  Json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!names.empty()) schema["required"] = names;
  return schema;
}

const char* json_type(BodyType type) {
  switch (type) {
    case BodyType::Text:
      return "string";
    case BodyType::Texts:
      return "object";
    case BodyType::Whole:
      return "integer";
    case BodyType::List:
      return "array";
  }
  return "object";
}

Json body_schema(const std::vector<BodyMember>& body) {
  Json properties = Json::object(), names = Json::array();
  for (const BodyMember& member : body) {
    Json& property = properties[std::string(member.name)];
    property["type"] = json_type(member.type);
    if (member.type == BodyType::Texts) property["additionalProperties"] = {{"type", "string"}};
    if (member.type == BodyType::List) property["items"] = {{"type", "object"}};
    property["description"] = std::string(member.description);
    if (member.is_required) names.push_back(std::string(member.name));
  }
  Json schema{{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (!names.empty()) schema["required"] = names;
  return schema;
}

Json operation_of(const Route& route) {
  Json schema{{"type", "string"}};
  if (route.type == kJson) schema = {{"type", "object"}};
  if (route.path == "/api/v1/status") schema = {{"$ref", "#/components/schemas/Status"}};
  if (route.command) schema = {{"$ref", "#/components/schemas/CommandAnswer"}};
  const Json error{
      {"description", "Refused"},
      {"content", {{std::string(kJson), {{"schema", {{"$ref", "#/components/schemas/Error"}}}}}}}};
  Json operation{
      {"summary", route.description},
      {"responses",
       {{"200", {{"description", "Success"}, {"content", {{route.type, {{"schema", schema}}}}}}},
        {"default", error}}}};
  if (route.role != Role::Nobody) {
    operation["x-role"] = std::string(word_for(kRoles, route.role));
    operation["security"] = Json::array({{{"session", Json::array()}}, {{"token", Json::array()}}});
    if (route.takes_password) operation["security"].push_back({{"password", Json::array()}});
  }
  if (!route.body.empty()) {
    operation["requestBody"] = {
        {"required", true},
        {"content", {{std::string(kJson), {{"schema", body_schema(route.body)}}}}}};
  }
  if (route.view != ViewArgument::None) {
    const bool is_one = route.view == ViewArgument::One;
    operation["parameters"] = {
        {{"name", "view"},
         {"in", "query"},
         {"required", is_one},
         {"description", is_one ? "Name of the view" : "Name of a view; may be repeated"},
         {"schema", {{"type", "string"}}}}};
  }
  for (const QueryArgument& argument : route.query) {
    operation["parameters"].push_back(
        {{"name", argument.name},
         {"in", "query"},
         {"required", argument.is_required},
         {"description", argument.description},
         {"schema", {{"type", argument.is_number ? "number" : "string"}}}});
  }
  if (route.command) {
    operation["operationId"] = std::string(route.command->name);
    operation["requestBody"] = {
        {"required", route.command->argument_count() > 0},
        {"content", {{std::string(kJson), {{"schema", command_schema(*route.command)}}}}}};
  }
  return operation;
}

}  // namespace

std::string openapi_json(const std::vector<Route>& routes) {
  Json paths = Json::object();
  for (const Route& route : routes) {
    if (route.is_page) continue;
    paths[route.path][route.method == "GET" ? "get" : "post"] = operation_of(route);
  }
  const Json text{{"type", "string"}};
  const Json all{
      {"openapi", "3.0.3"},
      {"info", {{"title", "orbwatch"}, {"version", ORBWATCH_VERSION}}},
      // Relative to this description, also below a path of a proxy.
      {"servers", Json::array({{{"url", "../.."}}})},
      {"paths", std::move(paths)},
      {"components",
       {{"securitySchemes",
         {{"session",
           {{"type", "apiKey"},
            {"in", "cookie"},
            {"name", std::string(kSessionCookie)},
            {"description", "Over HTTPS " + std::string(kSecureSessionCookie) +
                                ", below a path of a proxy " + std::string(kSecurePathCookie)}}},
          {"token", {{"type", "http"}, {"scheme", "bearer"}}},
          {"password",
           {{"type", "http"},
            {"scheme", "basic"},
            {"description", "A token as the password, with any name"}}}}},
        {"schemas",
         {{"Status", status_schema()},
          {"CommandAnswer",
           {{"type", "object"},
            {"properties", {{"result", {{"type", "integer"}}}, {"result_text", text}}}}},
          {"Error", {{"type", "object"}, {"properties", {{"error", text}}}}}}}}}};
  return all.dump();
}

}  // namespace orbwatch::app::web
