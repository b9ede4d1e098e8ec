#pragma once

#include <cstdint>

#include "app/commands.h"

namespace orbwatch::app::modbus {

/// The handshake with the PLC: it writes argument and command, then another sequence; the command
/// is carried out, and the sequence comes back as acknowledged. Counters, not toggle bits: those
/// are lost when two writes fall between two looks.
struct CommandRegisters {
  std::int32_t argument = 0;
  std::uint16_t command = 0;
  std::uint16_t sequence = 0;
  std::uint16_t acknowledged = 0;
  CommandResult result = CommandResult::Done;  ///< of the command acknowledged last
  std::uint16_t last_command = 0;              ///< the command acknowledged last; 0: none yet
};

/// Carries the command out when its sequence is not acknowledged yet, at most once per sequence.
/// Calls `handler` on this thread. Reentrant.
void carry_out(CommandRegisters& registers, const CommandHandler& handler);

}  // namespace orbwatch::app::modbus
