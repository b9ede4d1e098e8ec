#pragma once

#include <array>
#include <cstdint>

#include "app/commands.h"

namespace orbwatch::app::modbus {

/// The handshake with the PLC: it writes arguments and command, then another sequence; the command
/// is carried out, and the sequence comes back as acknowledged. Counters, not toggle bits: those
/// are lost when two writes fall between two looks.
struct CommandRegisters {
  std::array<std::int32_t, kMaxArguments> arguments{};  ///< value / the argument's scale
  std::uint16_t command = 0;
  std::uint16_t sequence = 0;
  std::uint16_t acknowledged = 0;
  CommandResult result = CommandResult::Done;  ///< of the command acknowledged last
  std::uint16_t last_command = 0;              ///< the command acknowledged last; 0: none yet
};

/// The command that the registers hold, its arguments in their units. Arguments that it does not
/// have, and all of an unknown one, are 0. Reentrant.
Command command_in(const CommandRegisters& registers);

/// Carries the command out when its sequence is not acknowledged yet, at most once per sequence;
/// true when it did. Calls `handler` on this thread. Reentrant.
bool carry_out(CommandRegisters& registers, const CommandHandler& handler);

}  // namespace orbwatch::app::modbus
