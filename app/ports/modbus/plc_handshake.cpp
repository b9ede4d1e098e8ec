// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/plc_handshake.h"

#include <utility>

namespace orbwatch::app::modbus {

Command command_in(const CommandRegisters& registers) {
  Command command{static_cast<CommandCode>(registers.command), {}, Giver("over Modbus")};
  const CommandInfo* info = find_command(command.code);
  if (!info) return command;
  for (std::size_t i = 0; i < info->argument_count(); ++i) {
    command.arguments[i] = registers.arguments[i] * info->arguments[i].scale;
  }
  return command;
}

PlcHandshake::PlcHandshake(CommandRecord& record, CommandHandler handler,
                           hal::Clock::duration timeout, hal::TimePoint now)
    : record_(record), handler_(std::move(handler)), timeout_(timeout), last_change_(now) {
  for (const CommandRecord::Entry& entry : record.entries()) {
    if (entry.id.client != kPlcClient) continue;
    CommandRegisters& command = registers_.command;
    command.sequence = command.acknowledged = static_cast<std::uint16_t>(entry.id.number);
    command.result = entry.result;
    command.last_command = entry.command;
  }
}

std::uint32_t PlcHandshake::write(const Write& write, const RegisterMap& map, hal::TimePoint now) {
  const std::lock_guard lock(mutex_);
  const std::uint16_t heartbeat = registers_.heartbeat;
  apply(write, map, registers_);
  if (registers_.heartbeat != heartbeat) {
    last_change_ = now;
    has_changed_ = true;
  }
  return std::exchange(registers_.result_acknowledged, 0);
}

bool PlcHandshake::has_command() const {
  const std::lock_guard lock(mutex_);
  return registers_.command.sequence != registers_.command.acknowledged;
}

void PlcHandshake::carry_out() {
  const CommandRegisters registers = this->registers().command;
  if (registers.sequence == registers.acknowledged) return;
  const Command command = command_in(registers);
  const CommandResult result =
      record_.carry_out({kPlcClient, registers.sequence}, command, [this](const Command& recorded) {
        const CommandResult checked = check(recorded);
        return checked == CommandResult::Done ? handler_(recorded) : checked;
      });
  acknowledge(registers, result);
}

void PlcHandshake::acknowledge(const CommandRegisters& command, CommandResult result) {
  const std::lock_guard lock(mutex_);
  registers_.command.acknowledged = command.sequence;
  registers_.command.result = result;
  registers_.command.last_command = command.command;
  if (result == CommandResult::Done &&
      command.command == static_cast<std::uint16_t>(CommandCode::SetProcessActive)) {
    set_active_ = command.arguments[0] != 0;
  }
}

hal::TimePoint PlcHandshake::supervise(hal::TimePoint now) {
  const std::lock_guard lock(mutex_);
  if (!is_supervised()) return hal::TimePoint::max();
  if (now - last_change_ <= timeout_) return last_change_ + timeout_ + hal::Clock::duration(1);
  if (!set_active_) return now + timeout_;
  const CommandResult result = handler_({CommandCode::SetProcessActive, {0}});
  set_active_ = result == CommandResult::Busy;  // true: retried later
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
