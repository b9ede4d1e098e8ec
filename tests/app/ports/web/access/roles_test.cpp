// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <atomic>
#include <filesystem>
#include <set>

#include "app/ports/web/page/page_files.h"
#include "app/recent_log.h"
#include "tests/app/ports/web/access/access_served.h"
#include "tests/app/ports/web/configuration/written_files.h"

/// Tests every route with every role against its declaration.
namespace orbwatch::app::web::tests {
namespace {

using testing::HasSubstr;

constexpr std::array kEveryRole{Role::Nobody, Role::Viewer, Role::Operator, Role::Integrator,
                                Role::Administrator};

/// Path of a request to the server.
struct Way {
  const char* name;
  std::vector<std::string> trusted_proxies;
  std::string headers;  ///< headers added by a proxy
};

const std::string kForwardedHeaders =
    "X-Forwarded-For: 203.0.113.9\r\nX-Forwarded-Proto: https\r\n";
const std::array kWays{Way{"Direct", {}, ""}, Way{"TrustedProxy", {"127.0.0.1"}, kForwardedHeaders},
                       Way{"UntrustedProxy", {}, kForwardedHeaders}};

class Roles : public AccessServed {
 protected:
  void SetUp() override {
    AccessServed::SetUp();
    add_one_of_each_role();
    serve();
  }
  void serve(const std::vector<std::string>& trusted_proxies = {}) {
    handler = [this](const Command&) {
      ++carried_out;
      return CommandResult::Done;
    };
    program.files = std::make_shared<WrittenFiles>();
    tables = [] { return std::vector<InterfaceTable>(); };
    program.log = std::make_shared<RecentLog>();
    WebSettings settings;
    settings.trusted_proxies = trusted_proxies;
    settings.max_connections_per_address = 100;  // closed connections still count for a moment
    start(settings);
  }
  /// Answer of a route to an empty object, which changes no role or password.
  Answer ask(const Route& route, const std::string& headers) const {
    return route.method == "POST" ? post(route.path, "{}", headers + kPageHeaders)
                                  : get(port(), route.path, headers);
  }
  static void expect_refused(const Answer& answer, const Route& route, Role role) {
    EXPECT_EQ(answer.status, role == Role::Nobody ? 401 : 403);
    const auto said = nlohmann::json::parse(answer.body);
    ASSERT_EQ(said.size(), 1U) << answer.body;
    EXPECT_THAT(said["error"].get<std::string>(),
                HasSubstr(route.method + " " + route.path + " needs the role " +
                          std::string(word_for(kRoles, route.role))));
  }
  void expect_what_is_declared(const Route& route, Role role, const std::string& headers) {
    SCOPED_TRACE(route.method + " " + route.path + " as " + std::string(word_for(kRoles, role)));
    const int before = carried_out;
    const Answer answer = ask(route, headers);
    if (role < route.role) {
      expect_refused(answer, route, role);
      EXPECT_EQ(carried_out, before);
    } else {
      EXPECT_NE(answer.status, 401) << answer.body;
      EXPECT_NE(answer.status, 403) << answer.body;
      EXPECT_NE(answer.status, 0);
    }
  }

  std::atomic<int> carried_out{0};
};

/// Tests each route and role on each path.
class RolesByWay : public Roles, public testing::WithParamInterface<Way> {
 protected:
  void SetUp() override { AccessServed::SetUp(); }
  void serve_with_users() {
    add_one_of_each_role();
    serve(GetParam().trusted_proxies);
  }
  std::string sent(const std::string& headers) const { return GetParam().headers + headers; }
};

TEST_P(RolesByWay, EachProgramGetsWhatItsRoleMayAndNothingElse) {
  serve_with_users();
  ASSERT_GT(sink->routes().size(), kCommands.size() + kPageFiles.size());
  for (const Route& route : sink->routes()) {
    for (const Role role : kEveryRole) expect_what_is_declared(route, role, sent(by_token(role)));
  }
  EXPECT_GT(carried_out, 0);
}

TEST_P(RolesByWay, EachPersonGetsWhatTheirRoleMayAndNothingElse) {
  serve_with_users();
  std::map<Role, std::string> sessions{{Role::Nobody, ""}};
  for (const auto& [name, role] : kRoles) {
    sessions[role] =
        cookie_of(post("/api/v1/login",
                       nlohmann::json{{"user", std::string(name)}, {"password", kPassword}}.dump(),
                       sent(kPageHeaders)));
    ASSERT_FALSE(sessions[role].empty()) << name;
  }
  for (const Route& route : sink->routes()) {
    if (route.path == "/api/v1/logout") continue;
    for (const Role role : kEveryRole) expect_what_is_declared(route, role, sent(sessions[role]));
  }
}

TEST_P(RolesByWay, WithoutUsersOnlyThisComputerItselfMayDoAnything) {
  serve(GetParam().trusted_proxies);
  const Role role = GetParam().headers.empty() ? Role::Administrator : Role::Nobody;
  for (const Route& route : sink->routes()) expect_what_is_declared(route, role, sent(""));
  EXPECT_EQ(carried_out > 0, role == Role::Administrator);
  EXPECT_FALSE(std::filesystem::exists(users_file(state_folder)));
}

INSTANTIATE_TEST_SUITE_P(Ways, RolesByWay, testing::ValuesIn(kWays),
                         [](const auto& way) { return std::string(way.param.name); });

TEST_F(Roles, OnlyThePageAndTheWayInAreForEverybody) {
  std::set<std::string> open;
  for (const Route& route : sink->routes()) {
    if (route.role == Role::Nobody && !route.is_page) open.insert(route.method + " " + route.path);
    if (route.is_page) {
      EXPECT_EQ(route.method, "GET") << route.path;
    }
  }
  EXPECT_THAT(open, testing::ElementsAre("GET /api/v1/session", "GET /healthz",
                                         "POST /api/v1/login", "POST /api/v1/set_first_password"));
}

TEST_F(Roles, EachCommandHasTheRoleOfTheList) {
  std::size_t commands = 0;
  for (const Route& route : sink->routes()) {
    if (!route.command) continue;
    ++commands;
    EXPECT_EQ(route.role, route.command->role) << route.path;
    EXPECT_GE(route.role, Role::Operator) << route.path << ": a viewer changes nothing";
  }
  EXPECT_EQ(commands, kCommands.size());
}

TEST_F(Roles, WhatIsWrittenAboutRolesIsWhatIsServed) {
  const auto described =
      nlohmann::json::parse(get(port(), "/api/v1/openapi.json", by_token(Role::Viewer)).body);
  for (const Route& route : sink->routes()) {
    if (route.is_page) continue;
    const auto& operation = described["paths"][route.path][route.method == "GET" ? "get" : "post"];
    EXPECT_EQ(operation.value("x-role", ""), word_for(kRoles, route.role)) << route.path;
    EXPECT_EQ(operation.contains("security"), route.role != Role::Nobody) << route.path;
  }
}

}  // namespace
}  // namespace orbwatch::app::web::tests
