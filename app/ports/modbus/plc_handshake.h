#pragma once

#include <cstdint>
#include <mutex>

#include "app/model/command.h"
#include "app/ports/modbus/map/process_image.h"
#include "app/ports/modbus/server/request.h"
#include "hal/clock.h"

namespace orbwatch::app::modbus {

/// The command in the registers, its arguments in their units. Arguments that it does not have, and
/// all of an unknown command, are 0. Reentrant.
Command command_in(const CommandRegisters& registers);

/// Executes the command if its sequence is not acknowledged yet, at most once per sequence; returns
/// whether it did. Calls `handler` on this thread. Reentrant.
bool execute(CommandRegisters& registers, const CommandHandler& handler);

/// The PLC's side of the registers: keeps what it writes, executes its commands, and supervises its
/// heartbeat. A PLC whose heartbeat stops cannot keep the process active: if it set it active, it
/// is set inactive again.
/// Thread-safe; executes one command after the other.
class PlcHandshake {
 public:
  /// `timeout`: the longest time between two changes of the heartbeat; 0: it is not supervised.
  /// `now`: supervision starts here.
  PlcHandshake(CommandHandler handler, hal::Clock::duration timeout, hal::TimePoint now);

  /// Executes a checked write. Returns the number of the result that it acknowledges; 0: none.
  std::uint32_t write(const Write& write, const RegisterMap& map, hal::TimePoint now);

  /// Reacts to a silent PLC. To be called again at the returned time, or earlier.
  hal::TimePoint supervise(hal::TimePoint now);

  PlcRegisters registers() const;
  PlcStatus status(hal::TimePoint now) const;

 private:
  bool is_supervised() const { return timeout_.count() > 0; }

  const CommandHandler handler_;
  const hal::Clock::duration timeout_;
  mutable std::mutex mutex_;
  PlcRegisters registers_;
  hal::TimePoint last_change_;  ///< of the heartbeat, or the start
  bool has_changed_ = false;
  bool set_active_ = false;  ///< by its last command about the process
};

}  // namespace orbwatch::app::modbus
