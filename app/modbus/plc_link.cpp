#include "app/modbus/plc_link.h"

#include <chrono>
#include <utility>

namespace orbwatch::app::modbus {

using std::chrono::milliseconds;

PlcLink::PlcLink(CommandHandler handler, hal::Clock::duration timeout, hal::TimePoint now)
    : handler_(std::move(handler)), timeout_(timeout), last_sign_(now) {}

std::uint32_t PlcLink::write(const Write& write, const RegisterMap& map, hal::TimePoint now) {
  const std::lock_guard lock(mutex_);
  const std::uint16_t heartbeat = registers_.heartbeat;
  apply(write, map, registers_);
  if (registers_.heartbeat != heartbeat) {
    last_sign_ = now;
    has_signed_ = true;
  }
  const CommandRegisters& command = registers_.command;
  if (carry_out(registers_.command, handler_) && command.result == CommandResult::Done &&
      command.last_command == static_cast<std::uint16_t>(CommandCode::SetProcessActive)) {
    said_active_ = command.arguments[0] != 0;
  }
  return std::exchange(registers_.result_taken, 0);
}

hal::TimePoint PlcLink::watch(hal::TimePoint now) {
  const std::lock_guard lock(mutex_);
  if (!is_watched()) return hal::TimePoint::max();
  if (now - last_sign_ <= timeout_) return last_sign_ + timeout_ + hal::Clock::duration(1);
  if (!said_active_) return now + timeout_;
  const CommandResult result = handler_({CommandCode::SetProcessActive, {0}});
  said_active_ = result == CommandResult::Busy;  // then it is tried again
  return now + timeout_;
}

PlcState PlcLink::state(hal::TimePoint now) const {
  const std::lock_guard lock(mutex_);
  const bool in_time = now - last_sign_ <= timeout_;
  PlcState state{.command = registers_.command, .heartbeat = registers_.heartbeat};
  state.is_alive = is_watched() && has_signed_ && in_time;
  state.is_silent = is_watched() && !in_time;
  if (has_signed_) state.age = std::chrono::duration_cast<milliseconds>(now - last_sign_);
  return state;
}

}  // namespace orbwatch::app::modbus
