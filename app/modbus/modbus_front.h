#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "app/modbus/access_list.h"
#include "app/modbus/counters.h"
#include "app/modbus/mbap_framer.h"
#include "app/modbus/modbus_settings.h"
#include "app/modbus/responder.h"
#include "hal/clock.h"
#include "hal/file_descriptor.h"
#include "proc/image/result.h"

namespace orbwatch::app::modbus {

/// The sockets before libmodbus: takes the clients that are let in, hands on what they ask frame by
/// frame, and ends every connection that is too slow, too quiet, takes no answers, or sends
/// something else than Modbus. No client can delay another: nothing here waits for one.
/// Thread rule: open, run and the destructor by one owner each after the other; stop is
/// thread-safe.
class ModbusFront {
 public:
  /// Answers one whole frame on a socket that does not block.
  using Answer =
      std::function<Answered(int socket, std::span<const std::uint8_t> frame, bool may_write)>;

  /// What else the serving thread does: called again and again, at the latest at the time that it
  /// returned.
  using Duty = std::function<hal::TimePoint()>;

  /// Listens; clients can connect from now on. Errors: address or port cannot be used. `counters`
  /// outlives the front.
  static Result<std::unique_ptr<ModbusFront>> open(const ModbusSettings& settings, Answer answer,
                                                   Duty duty, Counters& counters);

  /// The port that is listened on.
  int port() const { return port_; }

  /// Serves until stop().
  void run();

  void stop();

 private:
  struct Connection {
    std::uint64_t id = 0;
    hal::FileDescriptor socket{};
    HostAddress host{};
    bool may_write = false;
    bool has_asked = false;         ///< at least one whole request
    hal::TimePoint last_request{};  ///< or when it was opened
    hal::TimePoint frame_begin{};   ///< when the first byte of a frame came that is not whole yet
    MbapFramer framer{};
  };
  using Connections = std::vector<Connection>;

  ModbusFront(const ModbusSettings& settings, Answer answer, Duty duty, Counters& counters)
      : settings_(settings),
        answer_(std::move(answer)),
        duty_(std::move(duty)),
        counters_(counters) {}

  Result<> listen();
  Result<> watch();
  void accept_client();
  void pause_accepting();
  bool has_room_for(Permission permission);
  void serve(std::uint64_t id);
  bool answer_frames(Connection& connection);
  void drop(Connections::iterator connection);
  void drop_overdue();
  hal::TimePoint deadline(const Connection& connection) const;
  int milliseconds_to_wait(hal::TimePoint next) const;

  const ModbusSettings settings_;
  const Answer answer_;
  const Duty duty_;
  Counters& counters_;
  AccessList access_;
  hal::FileDescriptor listener_;
  hal::FileDescriptor epoll_;
  hal::FileDescriptor stop_;
  int port_ = 0;
  bool accepting_ = true;
  hal::TimePoint accept_again_;  ///< while not accepting
  std::uint64_t next_id_ = 0;
  Connections connections_;
};

}  // namespace orbwatch::app::modbus
