#pragma once

#include <cstdint>
#include <mutex>

#include "app/model/command.h"
#include "app/ports/modbus/map/process_image.h"
#include "app/ports/modbus/server/request.h"
#include "app/state/command_record.h"
#include "hal/clock.h"

namespace orbwatch::app::modbus {

/// The command in the registers, its arguments in their units. Arguments that it does not have, and
/// all of an unknown command, are 0. Reentrant.
Command command_in(const CommandRegisters& registers);

/// The PLC's side of the registers: keeps what it writes, carries its commands out, and supervises
/// its heartbeat. A PLC whose heartbeat stops cannot keep the process active: if it set it active,
/// it is set inactive again.
/// Thread-safe; carry_out on one thread.
class PlcHandshake {
 public:
  /// Continues with the PLC's newest command in `record`, which outlives this. `timeout`: the
  /// longest time between two changes of the heartbeat; 0: it is not supervised. `now`: supervision
  /// starts here.
  PlcHandshake(CommandRecord& record, CommandHandler handler, hal::Clock::duration timeout,
               hal::TimePoint now);

  /// Executes a checked write. Returns the number of the result that it acknowledges; 0: none.
  std::uint32_t write(const Write& write, const RegisterMap& map, hal::TimePoint now);

  /// A command waits: its sequence is not acknowledged.
  bool has_command() const;

  /// Carries out the command that waits, if one does, and acknowledges it; waits for the disk.
  /// While it does, the other functions do not wait. What is written over the command meanwhile is
  /// the next one.
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
  mutable std::mutex mutex_;  ///< of what follows, held only while it is copied or compared
  PlcRegisters registers_;
  hal::TimePoint last_change_;  ///< of the heartbeat, or the start
  bool has_changed_ = false;
  bool set_active_ = false;  ///< by its last command about the process
};

}  // namespace orbwatch::app::modbus
