// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <memory>
#include <mutex>

#include "app/ports/web/http/message.h"

struct MHD_Connection;

namespace orbwatch::app::web {

/// Passes a stream to its connection, which is suspended while there is no data to read. Thread
/// rule: read on the connection's thread; everything else on any thread.
class StreamSender {
 public:
  StreamSender(std::shared_ptr<Stream> stream, MHD_Connection* connection)
      : stream_(std::move(stream)), connection_(connection) {}

  /// Result for libmicrohttpd's callback: number of bytes written to `out`, 0: suspended.
  ssize_t read(char* out, std::size_t most);
  /// Reports that there is data to read again.
  void wake();
  /// Ends the stream. Its socket must have been shut down: the next write fails, and closes the
  /// connection.
  void end();

 private:
  void resume();

  const std::shared_ptr<Stream> stream_;
  MHD_Connection* const connection_;
  mutable std::mutex mutex_;
  bool is_suspended_ = false;
  bool has_ended_ = false;
};

}  // namespace orbwatch::app::web
