// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "app/ports/modbus/map/process_image.h"
#include "app/ports/modbus/modbus_settings.h"
#include "app/ports/modbus/server/access_list.h"
#include "app/ports/modbus/server/mbap_framer.h"
#include "app/ports/modbus/server/responder.h"
#include "hal/clock.h"
#include "hal/thread/file_descriptor.h"
#include "proc/image/result.h"

namespace orbwatch::app::modbus {

/// Modbus TCP: accepts permitted clients, forwards their requests frame by frame, and closes
/// connections that are too slow, do not receive answers, or do not speak Modbus. Idle connections
/// stay while there is room; TCP keep-alive detects dead clients. Sockets are non-blocking, so that
/// no client delays another.
/// Thread rule: open, run and the destructor by one owner, in this order; stop is thread-safe.
class TcpServer {
 public:
  /// Answers one complete frame on a non-blocking socket.
  using Answer =
      std::function<Outcome(int socket, std::span<const std::uint8_t> frame, bool may_write)>;

  /// Listens: clients can connect before run(). Errors: address or port cannot be used. `counters`
  /// outlives the server.
  static Result<std::unique_ptr<TcpServer>> open(const ModbusSettings& settings, Answer answer,
                                                 ServerCounters& counters);

  /// The listening port.
  int port() const { return port_; }

  /// Serves until stop().
  void run();

  void stop() { stop_.signal(); }

  /// A connected client.
  struct Client {
    HostAddress host{};
    bool may_write = false;
    std::uint64_t requests = 0;
    hal::TimePoint last_request{};  ///< or the time of connecting
  };
  /// Clients as of the newest round. Thread-safe.
  std::vector<Client> clients() const;

 private:
  struct Connection {
    std::uint64_t id = 0;
    hal::FileDescriptor socket{};
    HostAddress host{};
    bool may_write = false;
    std::uint64_t requests = 0;     ///< complete requests
    hal::TimePoint last_request{};  ///< or the time of opening
    hal::TimePoint frame_begin{};   ///< arrival of the first byte of an incomplete frame
    MbapFramer framer{};
  };
  using Connections = std::vector<Connection>;

  TcpServer(const ModbusSettings& settings, Answer answer, ServerCounters& counters)
      : settings_(settings), answer_(std::move(answer)), counters_(counters) {}

  Result<> listen();
  Result<> watch();
  void accept_client();
  void pause_accepting();
  bool has_room_for(Permission permission);
  void serve(std::uint64_t id);
  bool answer_frames(Connection& connection);
  void drop(Connections::iterator connection);
  void drop_overdue();
  void publish_clients();
  bool set_up(int socket) const;
  hal::TimePoint deadline(const Connection& connection) const;
  hal::TimePoint next_deadline() const;

  const ModbusSettings settings_;
  const Answer answer_;
  ServerCounters& counters_;
  AccessList access_;
  hal::FileDescriptor listener_;
  hal::FileDescriptor epoll_;
  hal::EventFd stop_;
  int port_ = 0;
  bool accepting_ = true;
  hal::TimePoint accept_again_;  ///< end of a pause of accepting
  std::uint64_t next_id_ = 0;
  Connections connections_;
  mutable std::mutex clients_mutex_;
  std::vector<Client> clients_;  ///< guarded by clients_mutex_
};

}  // namespace orbwatch::app::modbus
