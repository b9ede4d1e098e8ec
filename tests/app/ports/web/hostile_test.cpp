// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <random>
#include <vector>

#include "tests/app/ports/web/served.h"

/// Malicious clients, all on loopback and bounded in number and time.
namespace orbwatch::app::web::tests {
namespace {

class Hostile : public Served {
 protected:
  void TearDown() override {
    // Closed connections may still count for a moment.
    EXPECT_TRUE(eventually([&] { return get(port(), "/nothing").status == 404; }));
    EXPECT_TRUE(eventually([&] { return sink->statistics().connections == 0; }));
  }
  static WebSettings hurried() {
    WebSettings settings;
    settings.request_timeout = std::chrono::milliseconds(400);
    // This thread is the pipeline, and may be late.
    settings.status_timeout = std::chrono::hours(1);
    settings.max_connections = 400;
    settings.max_connections_per_address = 300;
    settings.max_streams = 200;
    return settings;
  }
};

TEST_F(Hostile, GarbageIsRefusedOrCutOff) {
  start(hurried());
  std::mt19937 random(1);  // NOLINT(bugprone-random-generator-seed): reproducible
  for (int i = 0; i < 120; ++i) {
    std::string bytes(1 + random() % 2000, '\0');
    for (char& c : bytes) c = static_cast<char>(random());
    if (i % 3 == 1) bytes = "GET /" + bytes + "\r\n\r\n";
    if (i % 3 == 2) bytes = request_text("GET", "/healthz", "X: " + bytes + "\r\n");
    Client client(port());
    client.send(bytes);
    ::shutdown(client.get(), SHUT_WR);
    const std::string answer = client.rest();
    EXPECT_TRUE(answer.empty() || answer.starts_with("HTTP/1.")) << answer;
  }
}

TEST_F(Hostile, NoPathLeadsToAFile) {
  start();
  for (const char* target :
       {"/../../../../etc/passwd", "/..%2f..%2f..%2fetc%2fpasswd", "/%2e%2e/%2e%2e/etc/passwd",
        "//etc/passwd", "/healthz/../../etc/passwd", "/healthz%00", "/healthz/", "/HEALTHZ",
        "/api/v1/status/.", "/%c0%ae%c0%ae/etc/passwd", "/\\..\\..\\etc\\passwd",
        "http://127.0.0.1/etc/passwd", "/snapshot.jpg?view=../../etc/passwd",
        "/stream.mjpg?view=front%00"}) {
    const Answer answer = get(port(), target);
    EXPECT_TRUE(answer.status == 404 || answer.status == 400) << target << " " << answer.status;
    EXPECT_EQ(answer.body.find("root:"), std::string::npos) << target;
  }
}

TEST_F(Hostile, BodiesBeyondTheLimitAreRefused) {
  start(hurried());
  const std::size_t most = WebSettings{}.max_body_bytes;
  EXPECT_EQ(request(port(), "POST", "/healthz", "", std::string(most, 'x')).status, 405);
  for (const char* length : {"65537", "99999999999", "18446744073709551615"}) {
    Client client(port());
    client.send("POST /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: " +
                std::string(length) + "\r\n\r\n");
    const int status = client.answer().status;
    EXPECT_TRUE(status == 413 || status == 400) << length << " " << status;
  }
  for (const char* length : {"99999999999999999999999999", "-1", "x"}) {
    Client client(port());
    client.send("POST /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\nContent-Length: " +
                std::string(length) + "\r\n\r\n");
    const int status = client.answer().status;
    EXPECT_TRUE(status == 413 || status == 400) << length << " " << status;
  }
  // Chunked bodies state no length.
  Client chunked(port());
  chunked.send("POST /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\nTransfer-Encoding: chunked\r\n\r\n");
  const std::string chunk = "4000\r\n" + std::string(0x4000, 'x') + "\r\n";
  for (int i = 0; i < 5; ++i) chunked.send(chunk);
  chunked.send("0\r\n\r\n");
  EXPECT_EQ(chunked.answer().status, 413);
}

TEST_F(Hostile, HeadersBeyondTheLimitAreRefused) {
  start();
  const Answer answer = get(port(), "/healthz", "X: " + std::string(100000, 'x') + "\r\n");
  EXPECT_TRUE(answer.status == 0 || answer.status >= 400) << answer.status;
  const Answer long_target = get(port(), "/" + std::string(100000, 'x'));
  EXPECT_TRUE(long_target.status == 0 || long_target.status >= 400) << long_target.status;
}

TEST_F(Hostile, RequestsThatArriveByteByByteAreCutOff) {
  start(hurried());
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 200; ++i) {
    clients.push_back(std::make_unique<Client>(port()));
    clients.back()->send("GET /healthz HTTP/1.1\r\nHost: 127.0.0.1\r\nX: ");
  }
  EXPECT_EQ(get(port(), "/healthz").status, 200) << "meanwhile";
  // They continue to send, so that none is silent.
  EXPECT_TRUE(eventually([&] {
    for (const auto& client : clients) client->send("x");
    return sink->statistics().overdue >= 200;
  }));
}

TEST_F(Hostile, OneAddressTakesNoMoreThanItsShare) {
  WebSettings settings;
  settings.max_connections_per_address = 8;
  // Longer than a busy machine needs to connect all clients, because overdue ones make room for
  // others.
  settings.request_timeout = std::chrono::milliseconds(2000);
  start(settings);
  std::vector<std::unique_ptr<Client>> clients;
  for (int i = 0; i < 100; ++i) clients.push_back(std::make_unique<Client>(port()));
  // Clients beyond the limit are closed at once, the others after their time limit.
  for (const auto& client : clients) EXPECT_EQ(client->rest(), "");
  // Counts are complete once all overdue connections are closed.
  EXPECT_TRUE(eventually([&] {
    const auto statistics = sink->statistics();
    return statistics.overdue + statistics.turned_away == 100;
  }));
  EXPECT_LE(sink->statistics().overdue, 8U);
}

TEST_F(Hostile, StreamsAreLimited) {
  WebSettings settings = hurried();
  settings.max_streams = 2;
  start(settings);
  Client first(port()), second(port());
  for (Client* client : {&first, &second}) {
    client->send(request_text("GET", "/stream.mjpg?view=front"));
    client->take_until("\r\n\r\n");
  }
  EXPECT_EQ(get(port(), "/stream.mjpg?view=front").status, 503);
  EXPECT_EQ(sink->statistics().streams_refused, 1U);
}

/// The pipeline's thread only stores pictures, and a fast reader gets every one of them, while a
/// hundred others hardly read.
TEST_F(Hostile, SlowReadersDelayNobody) {
  WebSettings settings = hurried();
  settings.request_timeout = std::chrono::minutes(1);  // slow readers are not ended
  start(settings);
  constexpr int kReceiveBuffer = 4096;
  std::vector<std::unique_ptr<Client>> slow;
  for (int i = 0; i < 100; ++i) {
    slow.push_back(std::make_unique<Client>(port(), kReceiveBuffer));
    slow.back()->send(request_text("GET", "/stream.mjpg?view=front"));
  }
  Client fast(port());
  fast.send(request_text("GET", "/stream.mjpg?view=front"));
  fast.take_until("\r\n\r\n");
  ASSERT_TRUE(eventually([&] { return sink->statistics().streams == 101; }));
  constexpr int kPictures = 60;
  for (int i = 1; i <= kPictures; ++i) {
    show(static_cast<std::uint64_t>(i), 320, 240);
    ASSERT_TRUE(fast.receive_until("\r\n\r\n")) << i;
    const std::string head = fast.take_until("\r\n\r\n");
    const std::size_t length = head.find("Content-Length: ");
    ASSERT_NE(length, std::string::npos) << head;
    const std::size_t bytes = std::stoul(head.substr(length + 16));
    EXPECT_GT(bytes, 20000U);
    EXPECT_EQ(fast.take(bytes).size(), bytes);
    fast.take_until("--orbwatch\r\n");
  }
  EXPECT_LT(sink->statistics().pictures_sent, 101U * kPictures / 2) << "they read it all";
  EXPECT_EQ(sink->statistics().pictures_replaced, 0U);
  // A reader that starts to read continues with the newest picture, without those in between.
  while (sink->statistics().pictures_skipped == 0) {
    ASSERT_NE(slow.front()->take_until("--orbwatch\r\n"), "");
  }
}

}  // namespace
}  // namespace orbwatch::app::web::tests
