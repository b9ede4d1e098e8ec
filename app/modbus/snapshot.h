#pragma once

#include <chrono>
#include <cstdint>

#include "app/modbus/command_registers.h"
#include "app/pipeline/status.h"

namespace orbwatch::app::modbus {

/// What the server has done since it was started.
struct Statistics {
  std::uint64_t answered = 0;     ///< requests, with or without an exception
  std::uint64_t refused = 0;      ///< answered with an exception, or not at all: no Modbus
  std::uint64_t dropped = 0;      ///< connections the server ended: too many, too slow, or garbage
  std::uint64_t connections = 0;  ///< open now
};

/// Everything one request is answered from: taken once per request, so that whatever a client reads
/// with it belongs together.
struct Snapshot {
  Status status;
  bool stale = false;                ///< the pipeline has been silent for too long
  std::chrono::milliseconds age{0};  ///< of the frame set, when the request came; max(): none yet
  std::chrono::microseconds utc{0};  ///< exposure start of the frame set since 1970; 0: none yet
  Statistics server;
  CommandRegisters command;
};

}  // namespace orbwatch::app::modbus
