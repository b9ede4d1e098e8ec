#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "app/ports/modbus/map/process_image.h"
#include "app/ports/modbus/modbus_settings.h"
#include "app/ports/modbus/server/responder.h"
#include "app/ports/modbus/server/rtu_framer.h"
#include "app/ports/modbus/server/transport.h"
#include "hal/clock.h"
#include "hal/thread/file_descriptor.h"

namespace orbwatch::app::modbus {

/// Modbus RTU: serves one unit on a serial line. A line that cannot be opened, or disconnects as
/// adapters on USB may, is opened again after 1 s, then every 2 s.
/// Thread rule: open, run and the destructor by one owner, in this order; stop is thread-safe.
class RtuServer {
 public:
  /// Answers one whole frame.
  using Answer = std::function<Outcome(Transport& transport, std::span<const std::uint8_t> frame)>;

  /// Called once with the error when the line is lost, and once when it is back, on the serving
  /// thread.
  using OnLine = std::function<void(const Result<>& line)>;

  /// Errors: the settings. `counters` outlives the server.
  static Result<std::unique_ptr<RtuServer>> open(const ModbusSerialSettings& settings,
                                                 Answer answer, OnLine on_line,
                                                 ServerCounters& counters);

  /// Serves until stop().
  void run();

  void stop() { stop_.signal(); }

 private:
  RtuServer(const ModbusSerialSettings& settings, std::unique_ptr<RtuTransport> transport,
            Answer answer, OnLine on_line, ServerCounters& counters)
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
  ServerCounters& counters_;
  hal::EventFd stop_;
};

}  // namespace orbwatch::app::modbus
