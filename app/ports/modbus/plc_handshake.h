// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <mutex>

#include "app/model/command/command.h"
#include "app/ports/modbus/map/process_image.h"
#include "app/ports/modbus/server/request.h"
#include "app/state/command_record.h"
#include "hal/clock.h"

namespace orbwatch::app::modbus {

/// The command in the registers, its arguments in their units. Arguments beyond those of the
/// command, and all arguments of an unknown command, are 0. Reentrant.
Command command_in(const CommandRegisters& registers);

/// Handshake with the PLC: keeps the registers that it writes, executes its commands, and
/// supervises its heartbeat. A PLC whose heartbeat stops cannot keep the process active: a process
/// that it set active is set inactive. Thread-safe; carry_out on one thread.
class PlcHandshake {
 public:
  /// Continues with the PLC's newest command in `record`, which outlives this. `timeout`: the
  /// longest time between two changes of the heartbeat; 0: not supervised. `now`: supervision
  /// starts here.
  PlcHandshake(CommandRecord& record, CommandHandler handler, hal::Clock::duration timeout,
               hal::TimePoint now);

  /// Executes a checked write. Returns the number of the result that it acknowledges; 0: none.
  std::uint32_t write(const Write& write, const RegisterMap& map, hal::TimePoint now);

  /// Returns whether a command waits, that is, its sequence is not acknowledged.
  bool has_command() const;

  /// Executes and acknowledges the waiting command, if any; waits for the disk. The other functions
  /// do not wait meanwhile. A command written over it meanwhile is the next one.
  void carry_out();

  /// Reacts to a silent PLC. To be called again at the returned time, or earlier.
  hal::TimePoint supervise(hal::TimePoint now);

  PlcRegisters registers() const;
  PlcStatus status(hal::TimePoint now) const;

 private:
  bool is_supervised() const { return timeout_.count() > 0; }

  void acknowledge(const CommandRegisters& command, CommandResult result);

  CommandRecord& record_;
  const CommandHandler handler_;
  const hal::Clock::duration timeout_;
  /// Guards the following members, held only for copies and comparisons.
  mutable std::mutex mutex_;
  PlcRegisters registers_;
  hal::TimePoint last_change_;  ///< last change of the heartbeat, or the start
  bool has_changed_ = false;
  bool set_active_ = false;  ///< set by the PLC's last command set_process_active
};

}  // namespace orbwatch::app::modbus
