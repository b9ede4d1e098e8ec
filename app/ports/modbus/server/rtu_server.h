// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "app/ports/modbus/map/process_image.h"
#include "app/ports/modbus/modbus_settings.h"
#include "app/ports/modbus/server/responder.h"
#include "app/ports/modbus/server/transport.h"
#include "hal/clock.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::modbus {

class EchoFilter;

/// Modbus RTU: serves one unit on a serial line. Opening a line is retried after 1 s, then every 2
/// s, when it fails or the line disconnects, as USB adapters may. Own answers echoed by the adapter
/// are dropped.
/// Thread rule: open, run and the destructor by one owner, in this order; stop is thread-safe.
class RtuServer {
 public:
  /// Answers one complete frame.
  using Answer = std::function<Outcome(Transport& transport, std::span<const std::uint8_t> frame)>;

  /// Called on the serving thread, once with the error when the line is lost, and once when it is
  /// open again.
  using OnLine = std::function<void(const Result<>& line)>;

  /// Called once, at the first echo of an answer, on the serving thread.
  using OnEcho = std::function<void()>;

  /// Errors: the settings. `counters` outlives the server.
  static Result<std::unique_ptr<RtuServer>> open(const ModbusSerialSettings& settings,
                                                 Answer answer, OnLine on_line,
                                                 ServerCounters& counters, OnEcho on_echo = {});

  /// Serves until stop().
  void run();

  void stop() { stop_.signal(); }

 private:
  RtuServer(const ModbusSerialSettings& settings, std::unique_ptr<RtuTransport> transport,
            Answer answer, OnLine on_line, ServerCounters& counters, OnEcho on_echo)
      : settings_(settings),
        transport_(std::move(transport)),
        answer_(std::move(answer)),
        on_line_(std::move(on_line)),
        counters_(counters),
        on_echo_(std::move(on_echo)) {}

  struct Reception;

  bool is_stopped_within(hal::Clock::duration time) const;
  Result<> serve_line();
  void receive(Reception& line, std::span<const std::uint8_t> bytes, hal::TimePoint silent_until);
  bool answer_frame(EchoFilter& echoes, std::span<const std::uint8_t> frame);
  void count(Reception& line);

  const ModbusSerialSettings settings_;
  const std::unique_ptr<RtuTransport> transport_;
  const Answer answer_;
  const OnLine on_line_;
  ServerCounters& counters_;
  OnEcho on_echo_;  ///< empty after its call
  hal::EventFd stop_;
};

}  // namespace orbwatch::app::modbus
