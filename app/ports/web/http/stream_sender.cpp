// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/http/stream_sender.h"

#include <microhttpd.h>

namespace orbwatch::app::web {

ssize_t StreamSender::read(char* out, std::size_t most) {
  // Under the lock, so that no wake() is lost between the empty read and the suspension.
  const std::lock_guard lock(mutex_);
  if (has_ended_) {
    // At the end of a stream libmicrohttpd (0.9.75) keeps the connection until another event wakes
    // its thread; a failed write closes it at once.
    out[0] = '\n';
    return 1;
  }
  const std::size_t count = stream_->read({out, most});
  if (count == 0) {
    is_suspended_ = true;
    ::MHD_suspend_connection(connection_);
  }
  return static_cast<ssize_t>(count);
}

void StreamSender::wake() {
  const std::lock_guard lock(mutex_);
  resume();
}

void StreamSender::end() {
  const std::lock_guard lock(mutex_);
  has_ended_ = true;
  resume();
}

void StreamSender::resume() {
  if (!is_suspended_) return;
  is_suspended_ = false;
  ::MHD_resume_connection(connection_);
}

}  // namespace orbwatch::app::web
