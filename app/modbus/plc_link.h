#pragma once

#include <cstdint>
#include <mutex>

#include "app/commands.h"
#include "app/modbus/plc_registers.h"
#include "app/modbus/request.h"
#include "app/modbus/snapshot.h"
#include "hal/clock.h"

namespace orbwatch::app::modbus {

/// The PLC's side of the registers: what it writes is kept here and carried out, and its heartbeat
/// is watched. A PLC that has fallen silent no longer vouches for what it said: when it was the one
/// to say that the process runs, that is taken back.
/// Thread-safe: what it carries out, it carries out one after the other.
class PlcLink {
 public:
  /// `timeout`: for how long the heartbeat may stand still; 0: it is not watched. `now`: from here
  /// on the PLC's silence counts.
  PlcLink(CommandHandler handler, hal::Clock::duration timeout, hal::TimePoint now);

  /// Carries a write out that was checked. The number of the result that it takes; 0: none.
  std::uint32_t write(const Write& write, const RegisterMap& map, hal::TimePoint now);

  /// Does what is due because the PLC is silent; to be called again at the returned time, or
  /// earlier.
  hal::TimePoint watch(hal::TimePoint now);

  PlcState state(hal::TimePoint now) const;

 private:
  bool is_watched() const { return timeout_.count() > 0; }

  const CommandHandler handler_;
  const hal::Clock::duration timeout_;
  mutable std::mutex mutex_;
  PlcRegisters registers_;
  hal::TimePoint last_sign_;  ///< of life: the heartbeat's last change
  bool has_signed_ = false;
  bool said_active_ = false;  ///< the process, by its last command about it
};

}  // namespace orbwatch::app::modbus
