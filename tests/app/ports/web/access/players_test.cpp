// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <openssl/evp.h>

#include "tests/app/ports/web/access/access_served.h"

/// Tests of players, recorders and dashboards that can send only a name and a password.
namespace orbwatch::app::web::tests {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string basic(const std::string& name, const std::string& password) {
  const std::string plain = name + ":" + password;
  std::string text(4 * ((plain.size() + 2) / 3) + 1, '\0');
  ::EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                    reinterpret_cast<const unsigned char*>(plain.data()),
                    static_cast<int>(plain.size()));
  return "Authorization: Basic " + std::string(text.c_str()) + "\r\n";
}

class Players : public AccessServed {
 protected:
  void SetUp() override {
    AccessServed::SetUp();
    add_one_of_each_role();
    start();
  }
  /// Raw head of an answer.
  std::string head(const std::string& target, const std::string& headers) const {
    Client client(port());
    client.send(request_text("GET", target, headers));
    return client.take_until("\r\n\r\n");
  }
  std::string viewer(const std::string& name = "recorder") const {
    return basic(name, tokens.at(Role::Viewer));
  }
};

TEST_F(Players, GetMetricsPicturesAndStreamsByATokenAsThePassword) {
  EXPECT_EQ(get(port(), "/metrics", viewer()).status, 200);
  EXPECT_EQ(get(port(), "/metrics", viewer("")).status, 200);
  EXPECT_EQ(get(port(), "/metrics", "authorization: bASIC  " + viewer().substr(21)).status, 200);
  EXPECT_THAT(head("/stream.mjpg?view=front", viewer()), HasSubstr("HTTP/1.1 200"));
  EXPECT_EQ(get(port(), "/snapshot.jpg", viewer()).status, 400) << "it names no view";
  EXPECT_EQ(sink->statistics().logins_failed, 0U);
}

TEST_F(Players, AreOfferedBasicWhereItCounts) {
  for (const char* target : {"/metrics", "/snapshot.jpg?view=front", "/stream.mjpg?view=front"}) {
    const std::string refused = head(target, "");
    EXPECT_THAT(refused, HasSubstr("HTTP/1.1 401"));
    EXPECT_THAT(refused, HasSubstr("WWW-Authenticate: Basic realm=\"orbwatch\"")) << target;
    EXPECT_THAT(refused, HasSubstr("WWW-Authenticate: Bearer")) << target;
  }
  EXPECT_THAT(head("/api/v1/status", ""), Not(HasSubstr("Basic")))
      << "a browser would ask for a password beside the page";
}

/// A browser sends the password of HTTP Basic by itself, also for a foreign page's request.
TEST_F(Players, CannotChangeAnything) {
  std::vector<std::string> routes;
  for (const Route& route : sink->routes()) {
    if (!route.takes_password) continue;
    EXPECT_EQ(route.method, "GET") << route.path;
    EXPECT_EQ(route.role, Role::Viewer) << route.path;
    routes.push_back(route.path);
  }
  EXPECT_THAT(routes, testing::UnorderedElementsAre("/metrics", "/snapshot.jpg", "/stream.mjpg"));
}

TEST_F(Players, AreNobodyElsewhere) {
  for (const Route& route : sink->routes()) {
    if (route.takes_password || route.role == Role::Nobody) continue;
    const std::string administrator = basic("admin", tokens.at(Role::Administrator));
    const Answer answer = request(port(), route.method, route.path, administrator + kPageHeaders,
                                  route.method == "POST" ? "{}" : "");
    EXPECT_EQ(answer.status, 401) << route.path;
  }
}

TEST_F(Players, CountAsFailedLoginsWithAWrongPassword) {
  for (int i = 0; i < LoginLimits::kFree; ++i) {
    EXPECT_EQ(get(port(), "/metrics", basic("viewer", i == 0 ? kPassword : "wrong")).status, 401);
  }
  EXPECT_EQ(sink->statistics().logins_failed, static_cast<std::uint64_t>(LoginLimits::kFree));
  const Answer limited = get(port(), "/metrics", viewer());
  EXPECT_EQ(limited.status, 429);
  EXPECT_FALSE(limited.headers.at("Retry-After").empty());
  EXPECT_EQ(login("viewer", kPassword).status, 429) << "the address waits";
  EXPECT_EQ(get(port(), "/metrics", by_token(Role::Viewer)).status, 200);
}

TEST_F(Players, MaySendAnythingElse) {
  for (const char* sent : {"", "Og==", "Og", "!!!!", "YWRtaW4=", "OmE=OmE="}) {
    const bool is_free = sink->statistics().logins_failed < LoginLimits::kFree;
    EXPECT_EQ(get(port(), "/metrics", std::string("Authorization: Basic ") + sent + "\r\n").status,
              is_free ? 401 : 429)
        << sent;
  }
}

/// The stream ends with the token, like other streams.
TEST_F(Players, LoseTheirStreamWithTheToken) {
  Client client(port());
  client.send(request_text("GET", "/stream.mjpg?view=front", viewer()));
  EXPECT_THAT(client.take_until("\r\n\r\n"), HasSubstr("200"));
  const Answer revoked = post("/api/v1/revoke_token", R"({"name":"viewer"})",
                              by_token(Role::Administrator) + kPageHeaders);
  ASSERT_EQ(revoked.status, 200) << revoked.body;
  client.rest();
  EXPECT_TRUE(eventually([&] { return sink->statistics().streams == 0; }));
}

}  // namespace
}  // namespace orbwatch::app::web::tests
