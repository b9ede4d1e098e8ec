// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include "app/ports/web/tls/server_certificate.h"
#include "app/state/private_file.h"
#include "tests/app/ports/web/access/access_served.h"
#include "tests/app/ports/web/tls/pem_files.h"
#include "tests/app/ports/web/tls/tls_client.h"

/// Tests HTTPS like a browser, by a client with another TLS library.
namespace orbwatch::app::web::tests {
namespace {

using nlohmann::json;
using std::chrono::days;
using std::chrono::seconds;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class Https : public AccessServed {
 protected:
  static WebSettings secure() {
    WebSettings settings;
    settings.https_port = 0;
    return settings;
  }
  int https() const { return sink->https_port(); }
  Answer login_over_https() const {
    const json body{{"user", "viewer"}, {"password", kPassword}};
    return tls_request(https(), "POST", "/api/v1/login", kPageHeaders, body.dump());
  }
};

TEST_F(Https, ServesWhatHttpServesWithACertificateOfItsOwnMaking) {
  start(secure());
  TlsClient client(https());
  ASSERT_TRUE(client.is_secure());
  EXPECT_EQ(client.version(), "TLSv1.3");
  EXPECT_EQ(client.fingerprint(), kept_certificate(state_folder).value()->fingerprint);
  EXPECT_TRUE(is_for_host(client.certificate(), "127.0.0.1"));
  client.send(request_text("GET", "/healthz"));
  const Answer answer = client.answer();
  EXPECT_EQ(answer.status, 200) << answer.body;
  EXPECT_FALSE(answer.headers.contains("Strict-Transport-Security"));
  EXPECT_EQ(get(port(), "/healthz").status, 200) << "as before";
  const double days_left = sink->statistics().certificate_days;
  EXPECT_GT(days_left, 820);
  EXPECT_THAT(get(port(), "/metrics").body, HasSubstr("orbwatch_web_certificate_days 82"));
}

TEST_F(Https, WithoutItThereIsNoPortAndNoCertificate) {
  start();
  EXPECT_EQ(https(), 0);
  EXPECT_FALSE(std::filesystem::exists(state_folder / "certificate.pem"));
  EXPECT_THAT(get(port(), "/metrics").body, HasSubstr("orbwatch_web_certificate_days Nan"));
}

TEST_F(Https, ShowsAnOwnCertificateWithItsIssuers) {
  const PemFiles files(folder.path());
  start(files.settings());
  const TlsClient client(https());
  ASSERT_TRUE(client.is_secure());
  EXPECT_EQ(client.fingerprint(), fingerprint_of(files.own.certificate));
  EXPECT_EQ(client.chain_length(), 2);
}

TEST_F(Https, SpeaksNoOldVersion) {
  start(secure());
  for (const int version : {TLS1_VERSION, TLS1_1_VERSION}) {
    EXPECT_FALSE(TlsClient(https(), "127.0.0.1", version).is_secure()) << version;
  }
  const TlsClient client(https(), "127.0.0.1", TLS1_2_VERSION);
  EXPECT_TRUE(client.is_secure());
  EXPECT_EQ(client.version(), "TLSv1.2");
}

TEST_F(Https, SpeaksNoSuiteWithCbc) {
  start(secure());
  const auto is_served = [&](const char* ciphers) {
    return TlsClient(https(), "127.0.0.1", TLS1_2_VERSION, 0, ciphers).is_secure();
  };
  for (const char* refused : {"ECDHE-ECDSA-AES128-SHA", "ECDHE-ECDSA-AES256-SHA",
                              "ECDHE-ECDSA-AES128-SHA256", "ECDHE-ECDSA-AES256-SHA384"}) {
    EXPECT_FALSE(is_served(refused)) << refused;
  }
  for (const char* served : {"ECDHE-ECDSA-AES128-GCM-SHA256", "ECDHE-ECDSA-AES256-GCM-SHA384",
                             "ECDHE-ECDSA-CHACHA20-POLY1305"}) {
    EXPECT_TRUE(is_served(served)) << served;
  }
}

TEST_F(Https, ItsCookieNeverCrossesTheNetworkInTheClear) {
  add_one_of_each_role();
  start(secure());
  const Answer answer = login_over_https();
  ASSERT_EQ(answer.status, 200) << answer.body;
  const std::string& cookie = answer.headers.at("Set-Cookie");
  EXPECT_THAT(cookie, AllOf(StartsWith("__Host-"), HasSubstr("; Secure"), HasSubstr("; HttpOnly"),
                            HasSubstr("; SameSite=Strict"), HasSubstr("; Path=/"),
                            Not(HasSubstr("Domain"))));
  const auto user = [&](bool is_secure, const std::string& sent) {
    const Answer said = is_secure ? tls_request(https(), "GET", "/api/v1/session", sent)
                                  : get(port(), "/api/v1/session", sent);
    return json::parse(said.body)["user"].get<std::string>();
  };
  EXPECT_EQ(user(true, cookie_of(answer)), "viewer");
  EXPECT_EQ(user(false, cookie_of(answer)), "") << "somebody on the way may have sent it";
  const Answer plain = login("viewer", kPassword);
  EXPECT_THAT(plain.headers.at("Set-Cookie"), Not(HasSubstr("Secure")));
  EXPECT_EQ(user(false, cookie_of(plain)), "viewer");
  EXPECT_EQ(user(true, cookie_of(plain)), "") << "somebody on the way may have set it";
}

TEST_F(Https, APageOverHttpIsAForeignOne) {
  add_one_of_each_role();
  start(secure());
  const std::string session = cookie_of(login_over_https()) + kPageHeaders;
  const auto log_out = [&](const std::string& scheme) {
    return tls_request(https(), "POST", "/api/v1/logout",
                       session + "Origin: " + scheme + "://127.0.0.1\r\n", "{}")
        .status;
  };
  EXPECT_EQ(log_out("http"), 403);
  EXPECT_EQ(log_out("https"), 200);
}

TEST_F(Https, FilesThatDoNotBelongTogetherAreAFaultUntilTheyAreMended) {
  const PemFiles files(folder.path());
  write_pem(files.key, to_pem(files.authority.key).value());
  sink = std::make_unique<WebSink>(on_a_free_port(files.settings()), make_context());
  const auto refused = sink->start();
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message,
              AllOf(HasSubstr(files.key.string()), HasSubstr("is not the key of")));
  EXPECT_EQ(https(), 0);
  sink->accept(app::tests::make_status());
  EXPECT_EQ(get(port(), "/healthz").status, 200) << "this computer is served meanwhile";
  write_pem(files.key, to_pem(files.own.key).value());
  const auto started = sink->start();
  ASSERT_TRUE(started) << started.error().message;
  EXPECT_EQ(tls_request(https(), "GET", "/healthz").status, 200);
}

TEST_F(Https, ASelfMadeCertificateIsReplacedWhileItServes) {
  const WebSettings settings = secure();
  const Credential ending =
      make_credential("ball", CertificateUse::Serve, valid_for(kRenewedBefore + seconds(8)),
                      nullptr, own_hosts(settings))
          .value();
  ASSERT_TRUE(write_private(state_folder / "certificate.pem",
                            to_pem(ending.certificate).value() + to_pem(ending.key).value()));
  start(settings);
  const int before = https();
  ASSERT_EQ(TlsClient(before).fingerprint(), fingerprint_of(ending.certificate));
  ASSERT_TRUE(eventually([&] { return sink->statistics().certificate_days > 800; }));
  EXPECT_EQ(https(), before);
  const TlsClient client(before);
  ASSERT_TRUE(client.is_secure());
  EXPECT_NE(client.fingerprint(), fingerprint_of(ending.certificate));
  EXPECT_EQ(client.fingerprint(), kept_certificate(state_folder).value()->fingerprint);
}

/// Pictures are larger than a record of TLS, and the connection waits between them.
TEST_F(Https, StreamsArriveWhole) {
  start(secure());
  TlsClient client(https());
  client.send(request_text("GET", "/stream.mjpg?view=front"));
  ASSERT_THAT(client.take_until("\r\n\r\n"), StartsWith("HTTP/1.1 200"));
  for (int i = 1; i <= 20; ++i) {
    show(static_cast<std::uint64_t>(i), 320, 240);
    const std::string head = client.take_until("\r\n\r\n");
    const std::size_t length = head.find("Content-Length: ");
    ASSERT_NE(length, std::string::npos) << head;
    const std::size_t bytes = std::stoul(head.substr(length + 16));
    const std::string picture = client.take(bytes);
    ASSERT_EQ(picture.size(), bytes);
    EXPECT_THAT(picture, AllOf(StartsWith("\xff\xd8"), testing::EndsWith("\xff\xd9")));
    client.take_until("--orbwatch\r\n");
  }
}

TEST_F(Https, NoReplyHoldsTheKey) {
  start(secure());
  const std::string pem = read_private(state_folder / "certificate.pem").value().value();
  const std::size_t key = pem.find('\n', pem.find("PRIVATE KEY")) + 1;
  const std::string secret = pem.substr(key, 40);
  for (const Route& route : sink->routes()) {
    if (route.method != "GET" || route.query) continue;
    EXPECT_EQ(tls_request(https(), "GET", route.path).body.find(secret), std::string::npos)
        << route.path;
  }
}

}  // namespace
}  // namespace orbwatch::app::web::tests
