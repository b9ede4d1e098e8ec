#include "app/modbus/command_registers.h"

namespace orbwatch::app::modbus {

Command command_in(const CommandRegisters& registers) {
  Command command{static_cast<CommandCode>(registers.command), {}};
  const CommandInfo* info = find_command(command.code);
  if (!info) return command;
  for (std::size_t i = 0; i < info->argument_count(); ++i) {
    command.arguments[i] = registers.arguments[i] * info->arguments[i].scale;
  }
  return command;
}

bool carry_out(CommandRegisters& registers, const CommandHandler& handler) {
  if (registers.sequence == registers.acknowledged) return false;
  const Command command = command_in(registers);
  registers.result = check(command);
  if (registers.result == CommandResult::Done) registers.result = handler(command);
  registers.last_command = registers.command;
  registers.acknowledged = registers.sequence;
  return true;
}

}  // namespace orbwatch::app::modbus
