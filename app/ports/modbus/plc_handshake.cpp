#include "app/ports/modbus/plc_handshake.h"

#include <utility>

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

bool execute(CommandRegisters& registers, const CommandHandler& handler) {
  if (registers.sequence == registers.acknowledged) return false;
  const Command command = command_in(registers);
  registers.result = check(command);
  if (registers.result == CommandResult::Done) registers.result = handler(command);
  registers.last_command = registers.command;
  registers.acknowledged = registers.sequence;
  return true;
}

PlcHandshake::PlcHandshake(CommandHandler handler, hal::Clock::duration timeout, hal::TimePoint now)
    : handler_(std::move(handler)), timeout_(timeout), last_change_(now) {}

std::uint32_t PlcHandshake::write(const Write& write, const RegisterMap& map, hal::TimePoint now) {
  const std::lock_guard lock(mutex_);
  const std::uint16_t heartbeat = registers_.heartbeat;
  apply(write, map, registers_);
  if (registers_.heartbeat != heartbeat) {
    last_change_ = now;
    has_changed_ = true;
  }
  const CommandRegisters& command = registers_.command;
  if (execute(registers_.command, handler_) && command.result == CommandResult::Done &&
      command.last_command == static_cast<std::uint16_t>(CommandCode::SetProcessActive)) {
    set_active_ = command.arguments[0] != 0;
  }
  return std::exchange(registers_.result_acknowledged, 0);
}

hal::TimePoint PlcHandshake::supervise(hal::TimePoint now) {
  const std::lock_guard lock(mutex_);
  if (!is_supervised()) return hal::TimePoint::max();
  if (now - last_change_ <= timeout_) return last_change_ + timeout_ + hal::Clock::duration(1);
  if (!set_active_) return now + timeout_;
  const CommandResult result = handler_({CommandCode::SetProcessActive, {0}});
  set_active_ = result == CommandResult::Busy;  // retried then
  return now + timeout_;
}

PlcRegisters PlcHandshake::registers() const {
  const std::lock_guard lock(mutex_);
  return registers_;
}

PlcStatus PlcHandshake::status(hal::TimePoint now) const {
  const std::lock_guard lock(mutex_);
  const bool in_time = now - last_change_ <= timeout_;
  return {.alive = is_supervised() && has_changed_ && in_time,
          .silent = is_supervised() && !in_time,
          .heartbeat = has_changed_ ? last_change_ : hal::TimePoint{}};
}

}  // namespace orbwatch::app::modbus
