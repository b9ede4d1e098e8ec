// SPDX-License-Identifier: Apache-2.0
#include "app/ports/console/waitless_output.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <climits>

namespace orbwatch::app {

WaitlessOutput::WaitlessOutput(int file) : file_(file) {
  struct stat about {};
  if (::fstat(file, &about) != 0) return;
  is_socket_ = S_ISSOCK(about.st_mode);
  if (!S_ISFIFO(about.st_mode) && !S_ISCHR(about.st_mode)) return;
  const std::string path = "/proc/self/fd/" + std::to_string(file);
  own_ = hal::FileDescriptor(::open(path.c_str(), O_WRONLY | O_NONBLOCK | O_NOCTTY | O_CLOEXEC));
}

bool WaitlessOutput::write(std::string_view text) {
  if (!rest_.empty()) send();
  if (!rest_.empty()) return false;
  rest_ = text;
  send();
  return true;
}

/// Writes as much as is accepted at once. Text that can never be written is dropped.
void WaitlessOutput::send() {
  while (!rest_.empty()) {
    ssize_t sent = -1;
    if (is_socket_) {
      sent = ::send(file_, rest_.data(), rest_.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
    } else if (own_.is_open()) {
      sent = ::write(own_.get(), rest_.data(), rest_.size());
    } else {
      // A regular file, or a pipe of another user, accepts this much if it is writable.
      pollfd ready{file_, POLLOUT, 0};
      if (::poll(&ready, 1, 0) <= 0) return;
      sent = ::write(file_, rest_.data(), std::min<std::size_t>(rest_.size(), PIPE_BUF));
    }
    if (sent < 0 && errno == EINTR) continue;
    if (sent < 0 && (errno == EAGAIN || errno == EWOULDBLOCK)) return;
    rest_.erase(0, sent < 0 ? rest_.size() : static_cast<std::size_t>(sent));
  }
}

}  // namespace orbwatch::app
