// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "hal/thread/file_descriptor.h"

namespace orbwatch::tests {

using Bytes = std::vector<std::uint8_t>;

struct Unconnected {};

/// A client that sends bytes over TCP, valid or not, to 127.0.0.1.
class RawClient {
 public:
  /// `from`: the client's own loopback address. `receive_buffer`: in bytes; 0 keeps the default.
  explicit RawClient(int port, const std::string& from = "127.0.0.1", int receive_buffer = 0);
  explicit RawClient(Unconnected);

  void connect(int port);

  bool send(const Bytes& bytes);
  /// Sends as much as is possible without waiting; -1 when the connection is broken.
  long send_some(const Bytes& bytes);
  /// Discards the received bytes and returns their number; -1 when the connection ended.
  long discard();
  /// Waits until all of this can be sent, or the connection is broken.
  void wait_writable();
  /// Receives exactly `count` bytes, or fewer when the connection ended.
  Bytes receive(std::size_t count);
  /// Waits for the server to end the connection; false when it sends something instead.
  bool is_closed_by_server();
  void finish_sending();

 private:
  hal::FileDescriptor socket_;
};

}  // namespace orbwatch::tests
