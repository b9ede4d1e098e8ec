#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>

#include "app/modbus/plc_registers.h"
#include "app/pipeline/status.h"

namespace orbwatch::app::modbus {

/// What the server has done since it was started.
struct Statistics {
  std::uint64_t answered = 0;     ///< requests, with or without an exception
  std::uint64_t refused = 0;      ///< answered with an exception, or not at all: no Modbus
  std::uint64_t dropped = 0;      ///< connections the server ended: too many, too slow, or garbage
  std::uint64_t connections = 0;  ///< open now
  std::uint64_t broken = 0;       ///< on the serial line: wrong checksum, cut off, or noise
  std::uint64_t for_others = 0;   ///< on the serial line: frames for or of other units
};

/// What was known at one moment.
struct Moment {
  Status status;
  std::chrono::microseconds utc{0};  ///< exposure start of its frame set since 1970; 0: none yet
};

/// What waits for the PLC to take it.
struct WaitingResults {
  Moment oldest{};  ///< its number is oldest.status.result; 0: none waits
  std::size_t count = 0;
  std::uint64_t refused = 0;     ///< results that came while the queue was full
  bool any_refused = false;      ///< since it was empty
  std::uint32_t last_taken = 0;  ///< 0: none yet
};

/// What is known about the PLC that writes.
struct PlcState {
  CommandRegisters command{};
  std::uint16_t heartbeat = 0;
  bool is_alive = false;                 ///< its heartbeat is watched and has changed in time
  bool is_silent = false;                ///< its heartbeat is watched and has not
  std::chrono::milliseconds age =        ///< of the heartbeat's last change;
      std::chrono::milliseconds::max();  ///< max(): none yet
};

/// Everything one request is answered from: taken once per request, so that whatever a client reads
/// with it belongs together.
struct Snapshot {
  Moment live;
  WaitingResults results;
  PlcState plc;
  Statistics server;
  bool stale = false;      ///< the pipeline has been silent for too long
  hal::TimePoint now{};    ///< when the request came
  hal::TimePoint start{};  ///< of the server
};

}  // namespace orbwatch::app::modbus
