#include "app/modbus/command_registers.h"

#include <algorithm>

namespace orbwatch::app::modbus {

void carry_out(CommandRegisters& registers, const CommandHandler& handler) {
  if (registers.sequence == registers.acknowledged) return;
  const auto code = static_cast<CommandCode>(registers.command);
  const bool known = std::ranges::count(kCommands, code, &CommandInfo::code) > 0;
  registers.result = known ? handler({code, registers.argument}) : CommandResult::UnknownCommand;
  registers.last_command = registers.command;
  registers.acknowledged = registers.sequence;
}

}  // namespace orbwatch::app::modbus
