// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/status/openapi.h"

#include <gtest/gtest.h>

#include <set>

#include "app/model/status/status.h"
#include "app/ports/web/routes.h"

namespace orbwatch::app::web {
namespace {

Json described() { return Json::parse(openapi_json(routes_of({}))); }

/// Fails for a member of an object without a description, at any depth.
void expect_described(const Json& schema, const std::string& place) {
  const Json members = schema.value("properties", Json::object());
  for (const auto& [name, member] : members.items()) {
    EXPECT_NE(member.value("description", ""), "") << place << "." << name;
    expect_described(member, place + "." + name);
  }
  for (const char* part : {"items", "additionalProperties"}) {
    if (schema.contains(part) && schema[part].is_object()) {
      expect_described(schema[part], place + "[]");
    }
  }
}

TEST(OpenApi, DescribesEveryMember) {
  for (const Route& route : routes_of({})) {
    for (const SchemaMaker& maker : {route.query, route.body, route.answer}) {
      if (maker) expect_described(maker(), route.path);
    }
  }
}

TEST(OpenApi, DescribesEachJsonAnswerAndEachBody) {
  for (const Route& route : routes_of({})) {
    EXPECT_TRUE(route.answer || route.type != kJson) << route.path;
    EXPECT_EQ(static_cast<bool>(route.body), route.method == "POST") << route.path;
  }
}

TEST(OpenApi, NamesEachOperationDifferently) {
  std::set<std::string> names;
  std::size_t operations = 0;
  const Json all = described();
  for (const Json& methods : all["paths"]) {
    for (const Json& operation : methods) {
      names.insert(operation["operationId"]);
      ++operations;
    }
  }
  EXPECT_EQ(names.size(), operations);
  EXPECT_EQ(operations, routes_of({}).size());
}

TEST(OpenApi, ArgumentsStateUnitAndPresence) {
  const Json all = described();
  const Json& parameters = all["paths"]["/api/v1/alignment/direction"]["get"]["parameters"];
  ASSERT_EQ(parameters.size(), 3U);
  const Json& u = parameters[1];
  EXPECT_EQ(u["name"], "u");
  EXPECT_EQ(u["in"], "query");
  EXPECT_EQ(u["required"], true);
  EXPECT_EQ(u["schema"]["type"], "number");
  EXPECT_EQ(u["schema"]["x-unit"], "px");
  EXPECT_TRUE(u["description"].get<std::string>().ends_with(", px")) << u["description"];
}

/// The page compares these codes by name.
TEST(OpenApi, CodesHaveNames) {
  const Json all = described();
  const Json& status = all["components"]["schemas"]["Status"]["properties"];
  const Json& state = status["system"]["properties"]["state"];
  EXPECT_EQ(state["enum"][1], static_cast<int>(SystemState::Running));
  EXPECT_EQ(state["x-enum-varnames"][1], "running");
  const Json& proposal = status["cameras"]["items"]["properties"]["proposal"];
  EXPECT_EQ(proposal["enum"], Json::parse("[0, 1, 2, 3]"));
  EXPECT_EQ(proposal["x-enum-varnames"], Json::parse(R"(["none", "working", "ready", "refused"])"));
}

TEST(OpenApi, EachSignalHasATitleOfItsOwn) {
  const Json all = described();
  const Json& region =
      all["components"]["schemas"]["Status"]["properties"]["regions"]["items"]["properties"];
  std::set<std::string> titles;
  for (const signals::SignalInfo& signal : signals::kSignals) {
    titles.insert(region[std::string(signal.name)]["title"]);
  }
  EXPECT_EQ(titles.size(), signals::kSignals.size());
  EXPECT_EQ(region["hot_spot_area_trend"]["title"], "Hot spot area, trend");
}

}  // namespace
}  // namespace orbwatch::app::web
