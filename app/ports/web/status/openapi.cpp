// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/status/openapi.h"

#include <algorithm>
#include <cctype>
#include <utility>

#include "app/ports/web/access/caller.h"

namespace orbwatch::app::web {
namespace {

/// Appends units to descriptions, because viewers of OpenAPI ignore x-unit, and null to the values
/// of an enum that allows it (OpenAPI 3.0.3, nullable).
void complete(Json& schema) {
  for (Json& part : schema) {
    if (part.is_structured()) complete(part);
  }
  if (schema.contains("x-unit")) {
    schema["description"] =
        schema.value("description", "") + ", " + schema["x-unit"].get_ref<const std::string&>();
  }
  if (schema.contains("enum") && schema.contains("nullable")) schema["enum"].push_back(nullptr);
}

Json schema_from(const SchemaMaker& maker) {
  Json schema = maker();
  complete(schema);
  return schema;
}

Json reference(const std::string& name) { return {{"$ref", "#/components/schemas/" + name}}; }

Json content_of(const std::string& type, Json schema) {
  return {{type, {{"schema", std::move(schema)}}}};
}

/// "history_alarms" for /api/v1/history/alarms; a command's own name.
std::string operation_id(const Route& route) {
  if (route.command) return std::string(route.command->name);
  constexpr std::string_view kFolder = "/api/v1/";
  std::string id = route.path.substr(route.path.starts_with(kFolder) ? kFolder.size() : 1);
  std::ranges::replace_if(
      id, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return id;
}

/// Name of an answer's schema that many routes answer, or that the page reads; empty: another one.
std::string shared_name(const Route& route) {
  if (route.command) return "CommandAnswer";
  return route.path == "/api/v1/status" ? "Status" : "";
}

/// Schema of the answer; a shared one goes to `shared`.
Json answer_schema(const Route& route, Json& shared) {
  if (!route.answer) {
    if (route.type == kJson) return {{"type", "object"}};
    Json text{{"type", "string"}};
    if (!route.type.starts_with("text/")) text["format"] = "binary";
    return text;
  }
  Json schema = schema_from(route.answer);
  const std::string name = shared_name(route);
  if (name.empty()) return schema;
  shared[name] = std::move(schema);
  return reference(name);
}

Json parameters_of(const Json& query) {
  Json parameters = Json::array();
  for (const auto& [name, member] : query.at("properties").items()) {
    Json schema = member;
    Json& parameter = parameters.emplace_back(Json{{"name", name}, {"in", "query"}});
    parameter["required"] = is_required(query, name);
    parameter["description"] = std::exchange(schema["description"], Json());
    schema.erase("description");
    parameter["schema"] = std::move(schema);
  }
  return parameters;
}

Json operation_of(const Route& route, Json& shared) {
  Json refusal = reference("Error");
  if (route.command) refusal = {{"anyOf", {refusal, reference("CommandAnswer")}}};
  Json operation{{"operationId", operation_id(route)}, {"summary", route.description}};
  if (route.role != Role::Nobody) {
    operation["x-role"] = word_for(kRoles, route.role);
    operation["security"] = Json::array({{{"session", Json::array()}}, {{"token", Json::array()}}});
    if (route.takes_password) operation["security"].push_back({{"password", Json::array()}});
  }
  if (route.query) operation["parameters"] = parameters_of(schema_from(route.query));
  if (route.body) {
    Json body = schema_from(route.body);
    const bool is_required = body.contains("required");
    operation["requestBody"] = {{"required", is_required},
                                {"content", content_of(std::string(kJson), std::move(body))}};
  }
  operation["responses"] = {{"200",
                             {{"description", "Success"},
                              {"content", content_of(route.type, answer_schema(route, shared))}}},
                            {"default",
                             {{"description", "Refused"},
                              {"content", content_of(std::string(kJson), std::move(refusal))}}}};
  return operation;
}

Json security_schemes() {
  return {{"session",
           {{"type", "apiKey"},
            {"in", "cookie"},
            {"name", kSessionCookie},
            {"description", "Over HTTPS " + std::string(kSecureSessionCookie) +
                                ", below a path of a proxy " + std::string(kSecurePathCookie)}}},
          {"token", {{"type", "http"}, {"scheme", "bearer"}}},
          {"password",
           {{"type", "http"},
            {"scheme", "basic"},
            {"description", "A token as the password, with any name"}}}};
}

}  // namespace

std::string openapi_json(const std::vector<Route>& routes) {
  Json paths = Json::object(), schemas = Json::object();
  schemas["Error"] = {
      {"type", "object"},
      {"properties",
       {{"error", {{"type", "string"}, {"description", "Reason of the refusal, in one line"}}}}},
      {"required", Json::array({"error"})}};
  for (const Route& route : routes) {
    if (route.is_page) continue;
    paths[route.path][route.method == "GET" ? "get" : "post"] = operation_of(route, schemas);
  }
  return json_text(
      {{"openapi", "3.0.3"},
       {"info", {{"title", "orbwatch"}, {"version", ORBWATCH_VERSION}}},
       // Relative to this description, also below a path of a proxy.
       {"servers", Json::array({{{"url", "../.."}}})},
       {"paths", std::move(paths)},
       {"components", {{"securitySchemes", security_schemes()}, {"schemas", std::move(schemas)}}}});
}

}  // namespace orbwatch::app::web
