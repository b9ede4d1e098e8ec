// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <thread>

#include "app/state/private_file.h"
#include "tests/app/ports/web/access/access_served.h"

/// Tests of login and of the administrator's routes, over the server.
namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using testing::HasSubstr;

json session_json(const std::string& role, const json& roles, bool has_users) {
  return {{"user", ""},
          {"role", role},
          {"roles", roles},
          {"password_characters", 12},
          {"has_users", has_users}};
}

class AccessRoutes : public AccessServed {
 protected:
  json session(const std::string& headers) const {
    return json::parse(get(port(), "/api/v1/session", headers).body);
  }
};

TEST_F(AccessRoutes, TheFirstPasswordIsSetFromThisComputerAndCountsFromThenOn) {
  start();
  EXPECT_EQ(
      session(""),
      session_json("administrator", {"viewer", "operator", "integrator", "administrator"}, false));
  EXPECT_EQ(get(port(), "/api/v1/status").status, 200);
  const Answer viewer =
      post("/api/v1/set_user",
           json{{"user", "kim"}, {"role", "viewer"}, {"password", kPassword}}.dump(), kPageHeaders);
  EXPECT_EQ(viewer.status, 409);
  EXPECT_THAT(viewer.body, HasSubstr("at least one user must be administrator"));
  const Answer weak =
      post("/api/v1/set_user",
           json{{"user", "kim"}, {"role", "administrator"}, {"password", "elevenchars"}}.dump(),
           kPageHeaders);
  EXPECT_EQ(weak.status, 400);
  EXPECT_EQ(get(port(), "/api/v1/status").status, 200);
  const Answer set =
      post("/api/v1/set_user",
           json{{"user", "kim"}, {"role", "administrator"}, {"password", kPassword}}.dump(),
           kPageHeaders);
  EXPECT_EQ(set.status, 200) << set.body;
  EXPECT_EQ(session(""), session_json("", json::array(), true));
  EXPECT_EQ(get(port(), "/api/v1/status").status, 401);
  EXPECT_EQ(get(port(), "/api/v1/status", session_of("kim")).status, 200);
}

TEST_F(AccessRoutes, TheCookieIsOutOfReachOfScriptsAndOfOtherSites) {
  add_one_of_each_role();
  start();
  const Answer answer = login("viewer", kPassword);
  ASSERT_EQ(answer.status, 200);
  const std::string& cookie = answer.headers.at("Set-Cookie");
  EXPECT_THAT(cookie, HasSubstr("; HttpOnly"));
  EXPECT_THAT(cookie, HasSubstr("; SameSite=Strict"));
  EXPECT_THAT(cookie, HasSubstr("; Path=/"));
  EXPECT_EQ(session(cookie_of(answer))["user"], "viewer");
}

TEST_F(AccessRoutes, LoggingOutEndsTheSession) {
  add_one_of_each_role();
  start();
  const std::string cookie = session_of("viewer");
  const Answer out = post("/api/v1/logout", "{}", cookie + kPageHeaders);
  EXPECT_EQ(out.status, 200);
  EXPECT_THAT(out.headers.at("Set-Cookie"), HasSubstr("Max-Age=0"));
  EXPECT_EQ(get(port(), "/api/v1/status", cookie).status, 401);
}

TEST_F(AccessRoutes, AForeignPageCannotUseASession) {
  add_one_of_each_role();
  start();
  const std::string cookie = session_of("administrator");
  const std::string remove = R"({"user":"viewer"})";
  for (const std::string& headers :
       {kJsonHeader, std::string("X-Orbwatch: page\r\n"),
        kPageHeaders + "Sec-Fetch-Site: cross-site\r\n",
        kPageHeaders + "Sec-Fetch-Site: same-site\r\n",
        kPageHeaders + "Origin: http://evil.example\r\n", kPageHeaders + "Origin: null\r\n"}) {
    const int status = post("/api/v1/remove_user", remove, cookie + headers).status;
    EXPECT_TRUE(status == 403 || status == 415) << headers << status;
  }
  EXPECT_EQ(session(session_of("viewer"))["user"], "viewer") << "still there";
  EXPECT_EQ(post("/api/v1/remove_user", remove, cookie + kPageHeaders).status, 200);
  EXPECT_EQ(login("viewer", kPassword).status, 401);
}

TEST_F(AccessRoutes, ATokenIsToldOnceAndEndsWithItsStreamWhenItIsRevoked) {
  add_one_of_each_role();
  start();
  const std::string admin = session_of("administrator") + kPageHeaders;
  const std::string asked = R"({"name":"grafana","role":"viewer"})";
  const Answer made = post("/api/v1/create_token", asked, admin);
  ASSERT_EQ(made.status, 200) << made.body;
  const std::string token = json::parse(made.body)["token"];
  EXPECT_EQ(post("/api/v1/create_token", asked, admin).status, 409);
  const std::string bearer = "Authorization: Bearer " + token + "\r\n";
  EXPECT_EQ(get(port(), "/metrics", bearer).status, 200);
  EXPECT_EQ(session(bearer)["user"], "grafana");
  Client stream(port());
  stream.send(request_text("GET", "/api/v1/live", bearer));
  EXPECT_THAT(stream.take_until("\r\n\r\n"), testing::StartsWith("HTTP/1.1 200"));
  EXPECT_EQ(post("/api/v1/revoke_token", R"({"name":"grafana"})", admin).status, 200);
  EXPECT_EQ(get(port(), "/metrics", bearer).status, 401);
  stream.rest();  // reads until the server closes
  EXPECT_TRUE(eventually([&] { return sink->statistics().streams == 0; }));
  EXPECT_EQ(post("/api/v1/revoke_token", R"({"name":"grafana"})", admin).status, 409);
}

TEST_F(AccessRoutes, TheLastAdministratorStays) {
  add_one_of_each_role();
  start();
  const std::string admin = session_of("administrator") + kPageHeaders;
  const Answer removed = post("/api/v1/remove_user", R"({"user":"administrator"})", admin);
  EXPECT_EQ(removed.status, 409);
  EXPECT_THAT(removed.body, HasSubstr("at least one user must be administrator"));
  EXPECT_EQ(post("/api/v1/set_user", R"({"user":"administrator","role":"viewer"})", admin).status,
            409);
  EXPECT_EQ(session(admin)["role"], "administrator");
}

TEST_F(AccessRoutes, OnesOwnPasswordIsChangedByEverybody) {
  add_one_of_each_role();
  start();
  const std::string before = session_of("viewer");
  const Answer changed = post("/api/v1/set_password",
                              json{{"old", kPassword}, {"new", "another long password"}}.dump(),
                              before + kPageHeaders);
  ASSERT_EQ(changed.status, 200) << changed.body;
  EXPECT_EQ(session(before)["user"], "");
  EXPECT_EQ(session(cookie_of(changed))["user"], "viewer");
  EXPECT_EQ(login("viewer", kPassword).status, 401);
}

TEST_F(AccessRoutes, APasswordSetByAnotherProcessCountsSoon) {
  add_one_of_each_role();
  start();
  const std::string before = session_of("viewer");
  ASSERT_TRUE(change_users(users_file(state_folder), [](Users& users) {
    return set_user(users, "viewer", std::nullopt, hash_password("forgotten no more").value());
  }));
  EXPECT_TRUE(eventually([&] { return get(port(), "/api/v1/status", before).status == 401; }));
  EXPECT_EQ(login("viewer", "forgotten no more").status, 200);
}

/// The file is changed before the server reads it again.
TEST_F(AccessRoutes, ThisComputerMakesNoTokenOnceAPasswordIsSet) {
  start();
  EXPECT_EQ(get(port(), "/api/v1/users").status, 200);
  add_one_of_each_role();
  const std::string asked = R"({"name":"backdoor","role":"administrator"})";
  EXPECT_EQ(post("/api/v1/create_token", asked, kPageHeaders).status, 401);
  EXPECT_EQ(load_users(users_file(state_folder)).value()->tokens.size(), kRoles.size());
}

TEST_F(AccessRoutes, BeforeTheFirstPasswordLoginsAreRefusedAtOnceAndLimited) {
  start();
  std::map<int, int> answers;
  for (int i = 0; i < 100; ++i) ++answers[login("admin", kPassword).status];
  EXPECT_EQ(answers, (std::map<int, int>{{409, 20}, {429, 80}}));
  add_one_of_each_role();
  EXPECT_EQ(login("administrator", kPassword).status, 200) << "the limit is of refusals only";
}

/// Checks all routes that an administrator can read.
TEST_F(AccessRoutes, NoReplyHoldsASecret) {
  add_one_of_each_role();
  start();
  const std::string cookie = session_of("administrator");
  const std::string token = cookie.substr(cookie.find('=') + 1, 43);
  const Users users = load_users(users_file(state_folder)).value().value();
  int read = 0;
  for (const Route& route : sink->routes()) {
    const bool is_of_views = route.query && route.query()["properties"].contains("view");
    if (route.method != "GET" || is_of_views) continue;
    const std::string body = get(port(), route.path, cookie).body;
    read += body.empty() ? 0 : 1;
    EXPECT_EQ(body.find("argon2"), std::string::npos) << route.path;
    EXPECT_EQ(body.find(token), std::string::npos) << route.path;
    for (const ApiToken& one : users.tokens) {
      EXPECT_EQ(body.find(one.hash), std::string::npos) << route.path;
    }
  }
  EXPECT_GT(read, 5);
  const Answer listed = get(port(), "/api/v1/users", cookie);
  EXPECT_EQ(json::parse(listed.body)["users"].size(), kRoles.size());
  EXPECT_EQ(json::parse(listed.body)["tokens"].size(), kRoles.size());
}

/// Simultaneous guesses by many clients are refused by one limit or another, and other clients are
/// served meanwhile.
TEST_F(AccessRoutes, AFloodOfLoginsDelaysNobodyElse) {
  add_one_of_each_role();
  WebSettings settings;
  settings.max_connections_per_address = 100;
  start(settings);
  constexpr int kGuesses = 40;
  std::vector<std::unique_ptr<Client>> guessing;
  for (int i = 0; i < kGuesses; ++i) {
    guessing.push_back(std::make_unique<Client>(port()));
    guessing.back()->send(request_text("POST", "/api/v1/login", kPageHeaders,
                                       R"({"user":"administrator","password":"a wrong guess"})"));
  }
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(get(port(), "/api/v1/status", by_token(Role::Viewer)).status, 200);
  }
  std::map<int, int> answers;
  for (const auto& client : guessing) ++answers[client->answer().status];
  EXPECT_EQ(answers[401] + answers[429] + answers[503], kGuesses);
  EXPECT_LE(answers[401], LoginLimits::kFree + 3) << "were judged";
  EXPECT_GT(answers[503], 0) << "no more than a few wait";
  Answer refused;
  ASSERT_TRUE(eventually([&] {
    refused = login("administrator", "a wrong guess");
    return refused.status == 429;
  }));
  EXPECT_GT(std::stoi(refused.headers.at("Retry-After")), 0);
}

}  // namespace
}  // namespace orbwatch::app::web::tests
