// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "app/ports/web/access/login/first_code.h"
#include "hal/socket_address.h"
#include "tests/app/ports/web/access/access_served.h"
#include "tests/app/ports/web/tls/pem_files.h"
#include "tests/app/ports/web/tls/tls_client.h"
#include "tests/support/network_namespace.h"

/// Tests answers to another computer: in a separate network, from an address other than loopback.
namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

constexpr const char* kOther = "10.77.0.1";

class BeyondLoopback : public AccessServed {
 protected:
  /// Runs `rest` in the test's network, with the sink.
  void served(const std::function<void()>& rest, WebSettings settings = {}) {
    ORBWATCH_REQUIRE_NETWORK_NAMESPACES();
    const orbwatch::tests::NetworkNamespace network;
    network.run([&] {
      orbwatch::tests::ip(std::string("address add ") + kOther + "/32 dev lo");
      if (settings.address == WebSettings{}.address) settings.address = "0.0.0.0";
      settings.https_port = 0;
      start(settings);
      rest();
      sink.reset();
    });
  }
  /// Returns whether the port on 127.0.0.1 accepts connections.
  static bool connects(int port) {
    const auto address = hal::parse_address("127.0.0.1", port);
    const hal::FileDescriptor socket(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    return ::connect(socket.get(), address->get(), address->length) == 0;
  }
  static Answer ask(int port, std::string_view method, std::string_view target,
                    const std::string& headers = "", std::string_view body = "") {
    Client client(port, 0, kOther);
    client.send(request_text(method, target, headers, body));
    return client.answer();
  }
  Answer ask_https(std::string_view method, std::string_view target,
                   const std::string& headers = "", std::string_view body = "") const {
    return tls_request(sink->https_port(), method, target, headers, body, kOther);
  }
};

TEST_F(BeyondLoopback, HttpOnlyLeadsToHttps) {
  add_one_of_each_role();
  served([&] {
    for (const char* target : {"/", "/metrics", "/api/v1/status", "/stream.mjpg?view=front"}) {
      const Answer answer = ask(port(), "GET", target, by_token(Role::Administrator));
      EXPECT_EQ(answer.status, 307) << target;
      EXPECT_EQ(answer.headers.at("Location"),
                "https://127.0.0.1:" + std::to_string(sink->https_port()) + target);
    }
    const Answer login = ask(port(), "POST", "/api/v1/login", kPageHeaders,
                             json{{"user", "administrator"}, {"password", kPassword}}.dump());
    EXPECT_EQ(login.status, 403);
    EXPECT_FALSE(login.headers.contains("Set-Cookie"));
    EXPECT_THAT(login.body, HasSubstr("HTTPS only"));
  });
}

TEST_F(BeyondLoopback, TheAddressOfANetworkLeavesThisComputerNotOut) {
  WebSettings settings;
  settings.address = kOther;
  served(
      [&] {
        EXPECT_EQ(get(port(), "/api/v1/status").status, 200);
        EXPECT_EQ(ask_https("GET", "/api/v1/status").status, 401);
        EXPECT_FALSE(connects(sink->https_port())) << "HTTPS is on the one network only";
      },
      settings);
}

TEST_F(BeyondLoopback, HttpsServesByRole) {
  add_one_of_each_role();
  served([&] {
    EXPECT_EQ(ask_https("GET", "/api/v1/status").status, 401);
    EXPECT_EQ(ask_https("GET", "/api/v1/status", by_token(Role::Viewer)).status, 200);
    EXPECT_EQ(ask_https("GET", "/api/v1/users", by_token(Role::Viewer)).status, 403);
  });
}

TEST_F(BeyondLoopback, WithoutUsersNobodyElseIsServedAnything) {
  served([&] {
    EXPECT_EQ(get(port(), "/api/v1/status").status, 200) << "on this computer";
    for (const Route& route : sink->routes()) {
      if (route.role == Role::Nobody) continue;
      EXPECT_EQ(ask_https(route.method, route.path, kPageHeaders, "{}").status, 401) << route.path;
    }
    const json user{{"user", "kim"}, {"role", "administrator"}, {"password", kPassword}};
    EXPECT_EQ(ask_https("POST", "/api/v1/set_user", kPageHeaders, user.dump()).status, 401);
    EXPECT_FALSE(std::filesystem::exists(users_file(state_folder)));
  });
}

TEST_F(BeyondLoopback, TheCodeLetsSomebodySetTheFirstPasswordOnce) {
  served([&] {
    const std::string code = kept_code(state_folder).value().value();
    const auto set = [&](const std::string& typed, const std::string& password) {
      return ask_https("POST", "/api/v1/set_first_password", kPageHeaders,
                       json{{"code", typed}, {"password", password}}.dump());
    };
    EXPECT_EQ(set("0000-0000", kPassword).status, 403);
    EXPECT_EQ(set(code, "elevenchars").status, 400);
    const Answer first = set(code, kPassword);
    ASSERT_EQ(first.status, 200) << first.body;
    EXPECT_THAT(first.headers.at("Set-Cookie"),
                AllOf(StartsWith("__Host-"), HasSubstr("; Secure")));
    const json session = json::parse(ask_https("GET", "/api/v1/session", cookie_of(first)).body);
    EXPECT_EQ(session["user"], "admin");
    EXPECT_EQ(session["role"], "administrator");
    EXPECT_EQ(set(code, "another long password").status, 409) << "used";
    EXPECT_EQ(kept_code(state_folder).value(), std::nullopt);
    EXPECT_EQ(get(port(), "/api/v1/status").status, 401) << "this computer, too";
    const Answer audit = ask_https("GET", "/api/v1/audit", cookie_of(first));
    EXPECT_THAT(audit.body, AllOf(HasSubstr("set_first_password"), HasSubstr("refused"),
                                  HasSubstr(kOther), testing::Not(HasSubstr(code))));
  });
}

TEST_F(BeyondLoopback, TheCodeIsNeverTakenOverHttp) {
  served([&] {
    const std::string code = kept_code(state_folder).value().value();
    const json body{{"code", code}, {"password", kPassword}};
    EXPECT_EQ(ask(port(), "POST", "/api/v1/set_first_password", kPageHeaders, body.dump()).status,
              403);
    EXPECT_FALSE(std::filesystem::exists(users_file(state_folder)));
  });
}

/// The code is not contained in any answer, and the wait for guesses increases.
TEST_F(BeyondLoopback, TheCodeIsNotGuessed) {
  served([&] {
    const std::string code = kept_code(state_folder).value().value();
    std::map<int, int> answers;
    for (int i = 0; i < 3 * LoginLimits::kFree; ++i) {
      const json body{{"code", random_code()}, {"password", kPassword}};
      ++answers[ask_https("POST", "/api/v1/set_first_password", kPageHeaders, body.dump()).status];
    }
    EXPECT_LE(answers[403], LoginLimits::kFree + 4) << "were judged";
    EXPECT_GT(answers[429], 0);
    EXPECT_EQ(answers[403] + answers[429], 3 * LoginLimits::kFree);
    EXPECT_EQ(sink->statistics().logins_failed, static_cast<std::uint64_t>(answers[403]));
    EXPECT_FALSE(std::filesystem::exists(users_file(state_folder)));
    for (const Route& route : sink->routes()) {
      if (route.method != "GET" || route.query) continue;
      EXPECT_EQ(get(port(), route.path).body.find(code), std::string::npos) << route.path;
    }
  });
}

}  // namespace
}  // namespace orbwatch::app::web::tests
