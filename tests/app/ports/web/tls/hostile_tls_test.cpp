// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <map>
#include <random>
#include <vector>

#include "tests/app/ports/web/access/access_served.h"
#include "tests/app/ports/web/tls/tls_client.h"

/// Malicious clients of HTTPS, all on loopback and bounded in number and time.
namespace orbwatch::app::web::tests {
namespace {

using testing::StartsWith;

class HostileTls : public AccessServed {
 protected:
  void TearDown() override {
    EXPECT_TRUE(eventually([&] { return tls_get("/nothing").status == 404; }));
    EXPECT_TRUE(eventually([&] { return sink->statistics().connections == 0; }));
  }
  static WebSettings hurried() {
    WebSettings settings;
    settings.https_port = 0;
    settings.request_timeout = std::chrono::milliseconds(800);
    settings.max_connections = 400;
    settings.max_connections_per_address = 300;
    return settings;
  }
  int https() const { return sink->https_port(); }
  Answer tls_get(std::string_view target) const { return tls_request(https(), "GET", target); }
};

TEST_F(HostileTls, GarbageIsCutOff) {
  start(hurried());
  std::mt19937 random(1);  // NOLINT(bugprone-random-generator-seed): reproducible
  for (int i = 0; i < 120; ++i) {
    std::string bytes(1 + random() % 2000, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    // A record of a TLS 1.2 handshake, and bytes that are not TLS.
    if (i % 3 == 1) bytes = std::string("\x16\x03\x03\x04\x00", 5) + bytes;
    if (i % 3 == 2) bytes = request_text("GET", "/healthz");
    Client client(https());
    client.send(bytes);
    ::shutdown(client.get(), SHUT_WR);
    EXPECT_THAT(client.rest(), testing::Not(StartsWith("HTTP"))) << i;
  }
}

TEST_F(HostileTls, HandshakesThatDoNotEndAreCutOff) {
  start(hurried());
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 200; ++i) {
    clients.push_back(std::make_unique<Client>(https()));
    // The head of a record whose content then arrives byte by byte.
    if (i % 2 == 1) clients.back()->send(std::string("\x16\x03\x01\x02\x00\x01", 6));
  }
  EXPECT_EQ(tls_get("/healthz").status, 200) << "meanwhile";
  EXPECT_EQ(get(port(), "/healthz").status, 200) << "meanwhile";
  EXPECT_TRUE(eventually([&] {
    for (std::size_t i = 1; i < clients.size(); i += 2) clients[i]->send("x");
    return sink->statistics().connections == 0;
  }));
}

TEST_F(HostileTls, RequestsThatArriveByteByByteAreCutOff) {
  start(hurried());
  std::vector<std::unique_ptr<TlsClient>> clients;
  for (int i = 0; i < 60; ++i) {
    clients.push_back(std::make_unique<TlsClient>(https()));
    clients.back()->send("GET /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\nX: ");
  }
  EXPECT_TRUE(eventually([&] {
    for (const auto& client : clients) client->send("x");
    return sink->statistics().overdue >= 60;
  }));
}

TEST_F(HostileTls, BodiesBeyondTheLimitAreRefused) {
  start(hurried());
  const std::size_t most = WebSettings{}.max_body_bytes;
  EXPECT_EQ(tls_request(https(), "POST", "/healthz", "", std::string(most, 'x')).status, 405);
  TlsClient stated(https());
  stated.send("POST /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: 99999999999\r\n\r\n");
  EXPECT_EQ(stated.answer().status, 413);
  TlsClient chunked(https());
  chunked.send("POST /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\nTransfer-Encoding: chunked\r\n\r\n");
  const std::string chunk = "4000\r\n" + std::string(0x4000, 'x') + "\r\n";
  for (int i = 0; i < 5; ++i) chunked.send(chunk);
  chunked.send("0\r\n\r\n");
  EXPECT_EQ(chunked.answer().status, 413);
}

TEST_F(HostileTls, NoPathLeadsToAFile) {
  start(hurried());
  for (const char* target :
       {"/../../../../etc/passwd", "/..%2f..%2f..%2fetc%2fpasswd", "//etc/passwd", "/healthz%00"}) {
    const Answer answer = tls_get(target);
    EXPECT_TRUE(answer.status == 404 || answer.status == 400) << target << " " << answer.status;
  }
}

/// Simultaneous guesses by many clients, each after its own handshake, while a fast client reads.
TEST_F(HostileTls, AFloodOfLoginsTakesNoPictureFromAReader) {
  add_one_of_each_role();
  WebSettings settings = hurried();
  settings.request_timeout = std::chrono::minutes(1);  // slow clients are not ended
  start(settings);
  TlsClient fast(https());
  fast.send(request_text("GET", "/stream.mjpg?view=front", by_token(Role::Viewer)));
  ASSERT_THAT(fast.take_until("\r\n\r\n"), StartsWith("HTTP/1.1 200"));
  std::vector<std::unique_ptr<TlsClient>> guessing;
  constexpr int kPictures = 60;
  for (int i = 1; i <= kPictures; ++i) {
    guessing.push_back(std::make_unique<TlsClient>(https()));
    guessing.back()->send(request_text("POST", "/api/v1/login", kPageHeaders,
                                       R"({"user":"administrator","password":"a wrong guess"})"));
    show(static_cast<std::uint64_t>(i), 320, 240);
    const std::string head = fast.take_until("\r\n\r\n");
    const std::size_t length = head.find("Content-Length: ");
    ASSERT_NE(length, std::string::npos) << i << " " << head;
    const std::size_t bytes = std::stoul(head.substr(length + 16));
    ASSERT_EQ(fast.take(bytes).size(), bytes);
    fast.take_until("--orbwatch\r\n");
  }
  std::map<int, int> answers;
  for (const auto& client : guessing) ++answers[client->answer().status];
  EXPECT_EQ(answers[401] + answers[429] + answers[503], kPictures);
  EXPECT_GT(answers[429] + answers[503], 0);
  EXPECT_EQ(sink->statistics().pictures_skipped, 0U);
  EXPECT_EQ(sink->statistics().pictures_replaced, 0U);
}

}  // namespace
}  // namespace orbwatch::app::web::tests
