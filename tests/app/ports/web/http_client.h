// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/time.h>

#include <array>
#include <cstdlib>
#include <map>
#include <span>
#include <string>
#include <string_view>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::web::tests {

inline const std::string kJsonHeader = "Content-Type: application/json\r\n";

/// Answer of a server.
struct Answer {
  int status = 0;  ///< 0: not an HTTP answer
  std::map<std::string, std::string> headers;
  std::string body;
};

/// A client that sends raw bytes over one connection, by default to 127.0.0.1. Reads time out after
/// 20 s.
class Client {
 public:
  explicit Client(int port, int receive_buffer = 0, const char* host = "127.0.0.1")
      : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (receive_buffer > 0) {
      ::setsockopt(get(), SOL_SOCKET, SO_RCVBUF, &receive_buffer, sizeof receive_buffer);
    }
    const timeval timeout{20, 0};
    ::setsockopt(get(), SOL_SOCKET, SO_RCVTIMEO, &timeout, sizeof timeout);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    EXPECT_EQ(::inet_pton(AF_INET, host, &address.sin_addr), 1);
    EXPECT_EQ(::connect(get(), reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  virtual ~Client() = default;
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  /// Sends bytes. False: the server has closed.
  bool send(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t sent = write(bytes);
      if (sent <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(sent));
    }
    return true;
  }

  /// Reads until the received data contains `text`; false: the connection ended before.
  bool receive_until(std::string_view text) {
    while (received_.find(text) == std::string::npos) {
      if (!receive()) return false;
    }
    return true;
  }

  /// Takes the next `count` bytes; fewer: the connection ended before.
  std::string take(std::size_t count) {
    while (received_.size() < count && receive()) {
    }
    std::string taken = received_.substr(0, count);
    received_.erase(0, count);
    return taken;
  }

  /// Takes the data up to and including `text`.
  std::string take_until(std::string_view text) {
    const bool found = receive_until(text);
    return take(found ? received_.find(text) + text.size() : received_.size());
  }

  /// Reads everything until the server closes.
  std::string rest() {
    while (receive()) {
    }
    return std::exchange(received_, {});
  }

  /// Reads one answer whose length is stated; one to HEAD has no body.
  Answer answer(bool has_body = true) {
    Answer answer;
    const std::string head = take_until("\r\n\r\n");
    if (!head.starts_with("HTTP/1.")) return answer;
    answer.status = std::atoi(head.c_str() + 9);
    for (std::size_t line = head.find("\r\n") + 2; line < head.size();) {
      const std::size_t end = head.find("\r\n", line);
      const std::size_t colon = head.find(": ", line);
      if (colon < end) {
        answer.headers[head.substr(line, colon - line)] = head.substr(colon + 2, end - colon - 2);
      }
      line = end + 2;
    }
    if (has_body && answer.headers.contains("Content-Length")) {
      answer.body = take(std::stoul(answer.headers["Content-Length"]));
    }
    return answer;
  }

  int get() const { return socket_.get(); }

 protected:
  /// Returns the number of bytes written; 0 or less: the server has closed.
  virtual ssize_t write(std::string_view bytes) const {
    return ::send(get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
  }
  virtual ssize_t read(std::span<char> out) { return ::recv(get(), out.data(), out.size(), 0); }

 private:
  bool receive() {
    std::array<char, 65536> block;
    const ssize_t count = read(block);
    if (count <= 0) return false;
    received_.append(block.data(), static_cast<std::size_t>(count));
    return true;
  }

  hal::FileDescriptor socket_;
  std::string received_;
};

/// A request in the form of a browser on this computer.
inline std::string request_text(std::string_view method, std::string_view target,
                                const std::string& headers = "", std::string_view body = "") {
  std::string text = std::string(method) + " " + std::string(target) +
                     " HTTP/1.1\r\nHost: 127.0.0.1\r\n" + headers;
  if (!body.empty()) text += "Content-Length: " + std::to_string(body.size()) + "\r\n";
  return text + "\r\n" + std::string(body);
}

/// One request over a connection of its own.
inline Answer request(int port, std::string_view method, std::string_view target,
                      const std::string& headers = "", std::string_view body = "") {
  Client client(port);
  client.send(request_text(method, target, headers, body));
  return client.answer(method != "HEAD");
}

inline Answer get(int port, std::string_view target, const std::string& headers = "") {
  return request(port, "GET", target, headers);
}

}  // namespace orbwatch::app::web::tests
