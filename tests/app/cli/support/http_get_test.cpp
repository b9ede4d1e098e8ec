// SPDX-License-Identifier: Apache-2.0
#include "app/cli/support/http_get.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <array>
#include <thread>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::cli::support {
namespace {

using testing::HasSubstr;

/// A server that answers one request with fixed bytes and keeps what it was sent.
class OneAnswer {
 public:
  explicit OneAnswer(std::string answer, bool closes = true)
      : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    address = *hal::parse_address("127.0.0.1", 0);
    EXPECT_EQ(::bind(listener_.get(), address.get(), address.length), 0);
    EXPECT_EQ(::listen(listener_.get(), 1), 0);
    EXPECT_EQ(::getsockname(listener_.get(), address.get(), &address.length), 0);
    thread_ = std::thread([this, answer = std::move(answer), closes] { serve(answer, closes); });
  }
  OneAnswer(const OneAnswer&) = delete;
  OneAnswer& operator=(const OneAnswer&) = delete;
  ~OneAnswer() { thread_.join(); }

  hal::SocketAddress address;
  std::string request;

 private:
  void serve(const std::string& answer, bool closes) {
    const hal::FileDescriptor client(::accept(listener_.get(), nullptr, nullptr));
    std::array<char, 4096> part{};
    while (request.find("\r\n\r\n") == std::string::npos) {
      const ssize_t got = ::read(client.get(), part.data(), part.size());
      if (got <= 0) return;
      request.append(part.data(), static_cast<std::size_t>(got));
    }
    ::send(client.get(), answer.data(), answer.size(), MSG_NOSIGNAL);
    // Until the client gives up.
    while (!closes && ::read(client.get(), part.data(), part.size()) > 0) {
    }
  }

  hal::FileDescriptor listener_;
  std::thread thread_;
};

TEST(HttpGet, ReturnsTheBody) {
  Result<std::string> body;
  std::string request;
  {
    OneAnswer server("HTTP/1.0 200 OK\r\nContent-Type: text/plain\r\n\r\nline\r\n\r\nmore");
    body = http_get(server.address, "/metrics");
    request = "GET /metrics HTTP/1.0\r\nHost: localhost\r\n";
    EXPECT_TRUE(server.request.starts_with(request)) << server.request;
  }
  ASSERT_TRUE(body) << body.error().message;
  EXPECT_EQ(*body, "line\r\n\r\nmore");
}

TEST(HttpGet, RefusesOtherAnswers) {
  for (const auto& [answer, reason] : std::vector<std::pair<std::string, std::string>>{
           {"HTTP/1.1 401 Unauthorized\r\n\r\n", "needs a login"},
           {"HTTP/1.1 503 Busy\r\n\r\n", "status 503"},
           {"HTTP/1.1 200 OK\r\nCut: off", "does not answer in HTTP"},
           {"SSH-2.0\r\n\r\n", "does not answer in HTTP"},
           {"", "does not answer in HTTP"}}) {
    OneAnswer server(answer);
    const auto body = http_get(server.address, "/");
    ASSERT_FALSE(body) << answer;
    EXPECT_THAT(body.error().message, HasSubstr(reason));
  }
  OneAnswer large("HTTP/1.1 200 OK\r\n\r\n" + std::string(4096, 'x'));
  EXPECT_FALSE(http_get(large.address, "/", {.bytes = 1000}));
}

TEST(HttpGet, GivesUpWhenNobodyAnswers) {
  hal::SocketAddress closed;
  {
    OneAnswer server("HTTP/1.1 200 OK\r\n\r\n");
    closed = server.address;
    EXPECT_TRUE(http_get(closed, "/"));
  }
  const auto refused = http_get(closed, "/");
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("cannot connect"));
  OneAnswer silent("HTTP/1.1 200 OK\r\n\r\nhalf", false);
  const auto late = http_get(silent.address, "/", {.time = std::chrono::milliseconds(50)});
  ASSERT_FALSE(late);
  EXPECT_THAT(late.error().message, HasSubstr("in time"));
}

}  // namespace
}  // namespace orbwatch::app::cli::support
