// SPDX-License-Identifier: Apache-2.0
#include "app/cli/support/http_get.h"

#include <poll.h>
#include <sys/socket.h>

#include <array>
#include <cerrno>
#include <optional>
#include <string_view>
#include <system_error>

#include "hal/clock.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::cli::support {
namespace {

using hal::FileDescriptor;

tl::unexpected<Error> system_error_of(const std::string& what) {
  return fail(what + ": " + std::system_category().message(errno));
}

Result<> wait_for(const FileDescriptor& socket, short event, hal::TimePoint deadline) {
  pollfd waiting{socket.get(), event, 0};
  while (::poll(&waiting, 1, hal::poll_timeout(deadline)) <= 0) {
    if (hal::Clock::now() >= deadline) return fail("does not answer in time");
  }
  return {};
}

Result<FileDescriptor> connected(const hal::SocketAddress& server, hal::TimePoint deadline) {
  FileDescriptor socket(::socket(server.family(), SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (!socket.is_open()) return system_error_of("cannot connect");
  if (::connect(socket.get(), server.get(), server.length) == 0) return socket;
  if (errno != EINPROGRESS) return system_error_of("cannot connect");
  if (auto ready = wait_for(socket, POLLOUT, deadline); !ready)
    return tl::unexpected(ready.error());
  socklen_t length = sizeof errno;
  if (::getsockopt(socket.get(), SOL_SOCKET, SO_ERROR, &errno, &length) != 0 || errno != 0) {
    return system_error_of("cannot connect");
  }
  return socket;
}

Result<> send_all(const FileDescriptor& socket, std::string_view text, hal::TimePoint deadline) {
  while (!text.empty()) {
    const ssize_t sent = ::send(socket.get(), text.data(), text.size(), MSG_NOSIGNAL);
    if (sent >= 0) {
      text.remove_prefix(static_cast<std::size_t>(sent));
    } else if (errno == EAGAIN) {
      if (auto ready = wait_for(socket, POLLOUT, deadline); !ready) return ready;
    } else if (errno != EINTR) {
      return system_error_of("cannot send");
    }
  }
  return {};
}

Result<std::string> receive_all(const FileDescriptor& socket, std::size_t most,
                                hal::TimePoint deadline) {
  std::string text;
  std::array<char, 16384> part{};
  while (true) {
    if (auto ready = wait_for(socket, POLLIN, deadline); !ready) {
      return tl::unexpected(ready.error());
    }
    const ssize_t got = ::recv(socket.get(), part.data(), part.size(), 0);
    if (got < 0 && (errno == EINTR || errno == EAGAIN)) continue;
    if (got < 0) return system_error_of("cannot receive");
    if (got == 0) return text;
    text.append(part.data(), static_cast<std::size_t>(got));
    if (text.size() > most) return fail("answers more than " + std::to_string(most >> 20) + " MiB");
  }
}

/// HTTP/1.0: the body ends with the connection.
Result<std::string> body_of(const std::string& answer) {
  constexpr std::string_view kEnd = "\r\n\r\n";
  constexpr std::size_t kStatus = 9, kDigits = 3;  // after "HTTP/1.1 "
  const std::size_t head = answer.find(kEnd);
  if (!answer.starts_with("HTTP/1.") || head == std::string::npos) {
    return fail("does not answer in HTTP");
  }
  const std::string status = answer.substr(kStatus, kDigits);
  if (status == "200") return answer.substr(head + kEnd.size());
  if (status == "401" || status == "403") return fail("needs a login: its users have passwords");
  return fail("answers with status " + status);
}

}  // namespace

Result<std::string> http_get(const hal::SocketAddress& server, const std::string& target,
                             const HttpLimits& limits) {
  const auto deadline = hal::Clock::now() + limits.time;
  const auto socket = connected(server, deadline);
  if (!socket) return tl::unexpected(socket.error());
  const std::string request =
      "GET " + target + " HTTP/1.0\r\nHost: localhost\r\nConnection: close\r\n\r\n";
  if (auto sent = send_all(*socket, request, deadline); !sent) {
    return tl::unexpected(sent.error());
  }
  return receive_all(*socket, limits.bytes, deadline).and_then(body_of);
}

}  // namespace orbwatch::app::cli::support
