// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "app/ports/web/access/login/first_code.h"
#include "tests/app/ports/web/access/access_served.h"

/// Tests a complete server behind reverse proxies, with their forms of requests.
namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

constexpr const char* kClient = "203.0.113.9";

std::string forwarded_for(const std::string& client, const std::string& scheme = "https") {
  return "X-Forwarded-For: " + client + "\r\nX-Forwarded-Proto: " + scheme + "\r\n";
}

class Proxies : public AccessServed {
 protected:
  void trust(WebSettings settings = {}) {
    settings.names = {"plant.example"};
    settings.trusted_proxies = {"127.0.0.1"};
    start(settings);
  }
  Answer login_with(const std::string& headers, const std::string& password = kPassword) const {
    return post("/api/v1/login", json{{"user", "viewer"}, {"password", password}}.dump(),
                headers + kPageHeaders);
  }
  /// Status of the answer to a raw request.
  int status_of(const std::string& text) const {
    Client client(port());
    client.send(text);
    return client.answer().status;
  }
};

TEST_F(Proxies, ThatEndTlsGetACookieForHttpsOnly) {
  add_one_of_each_role();
  trust();
  const Answer secure = login_with(forwarded_for(kClient));
  ASSERT_EQ(secure.status, 200) << secure.body;
  EXPECT_THAT(secure.headers.at("Set-Cookie"),
              AllOf(StartsWith("__Host-"), HasSubstr("; Path=/;"), HasSubstr("; Secure")));
  const Answer plain = login_with(forwarded_for(kClient, "http"));
  EXPECT_THAT(plain.headers.at("Set-Cookie"), Not(HasSubstr("Secure")));
}

TEST_F(Proxies, BelowAPathGetACookieForThatPath) {
  add_one_of_each_role();
  trust();
  const std::string path = forwarded_for(kClient) + "X-Forwarded-Prefix: /cell4/orbwatch\r\n";
  const Answer answer = login_with(path);
  ASSERT_EQ(answer.status, 200) << answer.body;
  EXPECT_THAT(
      answer.headers.at("Set-Cookie"),
      AllOf(StartsWith("__Secure-"), HasSubstr("; Path=/cell4/orbwatch/;"), HasSubstr("; Secure")));
  EXPECT_EQ(get(port(), "/api/v1/status", path + cookie_of(answer)).status, 200);
  EXPECT_EQ(post("/api/v1/logout", "{}", path + cookie_of(answer) + kJsonHeader).status, 403)
      << "without the page's own header";
  EXPECT_EQ(get(port(), "/api/v1/status", forwarded_for(kClient) + cookie_of(answer)).status, 401)
      << "another host's part may have set it";
}

TEST_F(Proxies, LimitAndNoteTheClientsThemselves) {
  add_one_of_each_role();
  trust();
  for (int i = 0; i < LoginLimits::kFree; ++i) {
    EXPECT_EQ(login_with(forwarded_for(kClient), "wrong").status, 401);
  }
  EXPECT_EQ(login_with(forwarded_for(kClient)).status, 429);
  const std::string audit =
      get(port(), "/api/v1/audit", by_token(Role::Administrator) + forwarded_for("203.0.113.10"))
          .body;
  EXPECT_THAT(audit, AllOf(HasSubstr(kClient), Not(HasSubstr("127.0.0.1"))));
}

TEST_F(Proxies, ThatAreNotTrustedAreThemselvesLimited) {
  add_one_of_each_role();
  start();
  for (int i = 0; i < LoginLimits::kFree; ++i) {
    const std::string spoofed = forwarded_for("203.0.113." + std::to_string(i));
    EXPECT_EQ(login_with(spoofed, "wrong").status, 401);
  }
  EXPECT_EQ(login_with(forwarded_for("203.0.113.99")).status, 429);
}

TEST_F(Proxies, ShareOutConnectionsByClient) {
  WebSettings settings;
  settings.max_connections_per_address = 2;
  add_one_of_each_role();
  trust(settings);
  std::vector<std::unique_ptr<Client>> streams;
  const auto begin = [&](const std::string& client) {
    streams.push_back(std::make_unique<Client>(port()));
    streams.back()->send(request_text("GET", "/stream.mjpg?view=front",
                                      by_token(Role::Viewer) + forwarded_for(client)));
    return streams.back()->take_until("\r\n").substr(0, 12);
  };
  for (const char* client : {kClient, kClient, "203.0.113.10", "203.0.113.10"}) {
    EXPECT_EQ(begin(client), "HTTP/1.1 200") << client;
  }
  EXPECT_EQ(begin(kClient), "HTTP/1.1 429");
  EXPECT_EQ(sink->statistics().turned_away, 1U);
  streams.clear();
  EXPECT_TRUE(eventually([&] { return sink->statistics().streams == 0; }));
  EXPECT_EQ(begin(kClient), "HTTP/1.1 200");
}

TEST_F(Proxies, LetTheCodeSetTheFirstPassword) {
  trust();
  const std::string code = kept_code(state_folder).value().value();
  EXPECT_EQ(json::parse(get(port(), "/api/v1/session", forwarded_for("127.0.0.1")).body)["role"],
            "");
  const Answer first =
      post("/api/v1/set_first_password", json{{"code", code}, {"password", kPassword}}.dump(),
           forwarded_for(kClient) + kPageHeaders);
  EXPECT_EQ(first.status, 200) << first.body;
}

TEST_F(Proxies, OverHttpAreServedWhereOthersAreLedToHttps) {
  WebSettings settings;
  settings.https_port = 0;
  add_one_of_each_role();
  trust(settings);
  EXPECT_EQ(get(port(), "/metrics", by_token(Role::Viewer) + forwarded_for(kClient)).status, 200);
  sink.reset();
  WebSettings alone;
  alone.https_port = 0;
  start(alone);
  EXPECT_EQ(get(port(), "/metrics", by_token(Role::Viewer)).status, 200);
  EXPECT_EQ(get(port(), "/metrics", by_token(Role::Viewer) + forwarded_for(kClient)).status, 307);
  EXPECT_THAT(login_with(forwarded_for(kClient)).body, HasSubstr("trusted_proxies"));
}

TEST_F(Proxies, PassOnWhatOurOwnPageCausesAndNothingElse) {
  add_one_of_each_role();
  trust();
  const auto status = [&](const std::string& headers) {
    Client client(port());
    client.send("POST /api/v1/command/start HTTP/1.1\r\nHost: plant.example\r\n" + kPageHeaders +
                by_token(Role::Administrator) + headers + "Content-Length: 2\r\n\r\n{}");
    return client.answer().status;
  };
  constexpr int kForeign = 403;
  const std::string tls = forwarded_for(kClient), plain = forwarded_for(kClient, "http");
  for (const std::string& own :
       {tls + "Origin: https://plant.example\r\n", plain + "Origin: http://plant.example\r\n",
        tls + "Origin: https://plant.example\r\nX-Forwarded-Host: plant.example:443\r\n",
        std::string("Origin: https://PLANT.example\r\nX-Forwarded-Proto: https\r\n"),
        std::string("Sec-Fetch-Site: same-origin\r\nOrigin: https://plant.example:444\r\n")}) {
    EXPECT_NE(status(own), kForeign) << own;
  }
  for (const std::string& foreign :
       {tls + "Origin: http://plant.example\r\n", tls + "Origin: https://evil.example\r\n",
        tls + "Origin: https://plant.example:444\r\n", tls + "Origin: null\r\n",
        tls + "Sec-Fetch-Site: cross-site\r\nOrigin: https://plant.example\r\n"}) {
    EXPECT_EQ(status(foreign), kForeign) << foreign;
  }
}

/// Bytes that a proxy regards as the body of one client's request must not become the next client's
/// request.
TEST_F(Proxies, SeeTheEndOfARequestWhereWeDo) {
  trust();
  Client client(port());
  client.send(
      "POST /api/v1/login HTTP/1.1\r\nHost: plant.example\r\nContent-Length: 44\r\n"
      "Transfer-Encoding: chunked\r\n\r\n0\r\n\r\nGET /healthz HTTP/1.1\r\nHost: "
      "127.0.0.1\r\n\r\n");
  EXPECT_EQ(client.answer().status, 400);
  EXPECT_EQ(client.rest(), "") << "what followed was answered";
}

TEST_F(Proxies, MayCheckHealthByTheOldVersion) {
  trust();
  EXPECT_EQ(status_of("GET /healthz HTTP/1.0\r\n\r\n"), 200);
  EXPECT_EQ(status_of("GET /healthz HTTP/1.0\r\nHost: evil.example\r\n\r\n"), 421);
  EXPECT_EQ(status_of("GET /healthz HTTP/1.1\r\n\r\n"), 400);
}

TEST_F(Proxies, MaySendEachFormOfARequest) {
  add_one_of_each_role();
  trust();
  const auto asked = [](const std::string& target, const std::string& host) {
    return "GET " + target + " HTTP/1.1\r\nHost: " + host + "\r\n\r\n";
  };
  EXPECT_EQ(status_of(asked("http://plant.example/healthz", "elsewhere.example")), 200);
  EXPECT_EQ(status_of(asked("HTTP://127.0.0.1/healthz?a=b", "127.0.0.1")), 200);
  EXPECT_EQ(status_of(asked("http://evil.example/healthz", "plant.example")), 421);
  EXPECT_EQ(status_of(asked("/healthz", "plant.example.")), 200);
  EXPECT_EQ(status_of(asked("/healthz", "plant.example\r\nHost: plant.example")), 400);
  for (const char* type : {"Application/JSON", "application/json ; charset=UTF-8",
                           "application/json;charset=utf-8", "APPLICATION/json\t;x=y"}) {
    EXPECT_NE(post("/api/v1/command/start", "{}",
                   by_token(Role::Administrator) + "Content-Type: " + type + "\r\n")
                  .status,
              415)
        << type;
  }
}

}  // namespace
}  // namespace orbwatch::app::web::tests
