// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>

namespace orbwatch::tests {

/// Replacement for systemd: receives the messages of sd_notify(). Programs started while it exists
/// send here.
class NotifySocket {
 public:
  /// `watchdog`: the service manager's timeout; 0: none.
  NotifySocket(const std::filesystem::path& path, std::chrono::milliseconds watchdog)
      : socket_(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
    EXPECT_EQ(::bind(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address), 0) << path;
    ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
    if (watchdog.count() == 0) return;
    ::setenv("WATCHDOG_USEC", std::to_string(watchdog.count() * 1000).c_str(), 1);
  }
  NotifySocket(const NotifySocket&) = delete;
  NotifySocket& operator=(const NotifySocket&) = delete;
  ~NotifySocket() {
    ::unsetenv("NOTIFY_SOCKET");
    ::unsetenv("WATCHDOG_USEC");
    ::close(socket_);
  }

  /// The next message; nullopt: none within `patience`.
  std::optional<std::string> next(std::chrono::milliseconds patience) const {
    pollfd waiting{socket_, POLLIN, 0};
    if (::poll(&waiting, 1, static_cast<int>(patience.count())) <= 0) return std::nullopt;
    std::array<char, 4096> text{};
    const auto size = ::recv(socket_, text.data(), text.size(), 0);
    return std::string(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  }

  /// Receives messages until one has this text; fails after a minute without any, or a thousand
  /// others.
  std::string await(const std::string& text) const {
    for (int i = 0; i < 1000; ++i) {
      const auto message = next(std::chrono::minutes(1));
      if (!message) break;
      if (message->find(text) != std::string::npos) return *message;
    }
    ADD_FAILURE() << "no message with " << text;
    return {};
  }

  /// True if messages cease: `many` is more than can be in transit.
  bool falls_silent(std::chrono::milliseconds patience, int many) const {
    for (int i = 0; i < many; ++i) {
      if (!next(patience)) return true;
    }
    return false;
  }

 private:
  const int socket_;
};

}  // namespace orbwatch::tests
