#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "app/modbus/counters.h"
#include "app/modbus/modbus_settings.h"
#include "app/modbus/responder.h"
#include "app/modbus/rtu_framer.h"
#include "app/modbus/rtu_transport.h"
#include "hal/clock.h"
#include "hal/file_descriptor.h"

namespace orbwatch::app::modbus {

/// Serves one unit on a serial line. A line that cannot be opened, or goes away as adapters on USB
/// do, is tried again after 1 s, then 2 s, up to every 10 s.
/// Thread rule: open, run and the destructor by one owner each after the other; stop is
/// thread-safe.
class RtuServer {
 public:
  /// Answers one whole frame.
  using Answer = std::function<Answered(Transport& transport, std::span<const std::uint8_t> frame)>;

  /// Told once that the line is lost and why, and once that it is back, on the serving thread.
  using OnLine = std::function<void(const Result<>& line)>;

  /// Errors: the settings. `counters` outlives the server.
  static Result<std::unique_ptr<RtuServer>> open(const ModbusSerialSettings& settings,
                                                 Answer answer, OnLine on_line, Counters& counters);

  /// Serves until stop().
  void run();

  void stop();

 private:
  RtuServer(const ModbusSerialSettings& settings, std::unique_ptr<RtuTransport> transport,
            Answer answer, OnLine on_line, Counters& counters)
      : settings_(settings),
        transport_(std::move(transport)),
        answer_(std::move(answer)),
        on_line_(std::move(on_line)),
        counters_(counters) {}

  bool is_stopped_within(hal::Clock::duration time) const;
  Result<> serve_line();
  void answer_frames(RtuFramer& framer);

  const ModbusSerialSettings settings_;
  const std::unique_ptr<RtuTransport> transport_;
  const Answer answer_;
  const OnLine on_line_;
  Counters& counters_;
  hal::FileDescriptor stop_;
};

}  // namespace orbwatch::app::modbus
