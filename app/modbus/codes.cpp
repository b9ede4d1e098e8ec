#include "app/modbus/codes.h"

#include <string_view>

#include "app/commands.h"
#include "app/pipeline/status.h"
#include "hal/fault.h"
#include "proc/signals/alarm_state.h"

namespace orbwatch::app::modbus {
namespace {

/// Without a default, so that the compiler asks for the text of a state that is appended.
std::string_view meaning(SystemState state) {
  switch (state) {
    case SystemState::Starting:
      return "starting: no frame set yet";
    case SystemState::Running:
      return "running: every camera delivers";
    case SystemState::Degraded:
      return "degraded: some camera has a fault";
    case SystemState::Fault:
      return "fault: no camera delivers, or the pipeline is silent";
    case SystemState::Stopped:
      return "stopped: told not to measure";
  }
  return {};
}

std::string_view meaning(CommandResult result) { return operator_text(result); }

std::string_view meaning(hal::Fault fault) {
  constexpr auto kNone = static_cast<hal::Fault>(0xff);
  const std::string_view text = hal::operator_text(fault);
  return text == hal::operator_text(kNone) ? std::string_view{} : text;
}

std::string_view meaning(signals::AlarmState state) { return signals::operator_text(state); }
std::string_view meaning(signals::AlarmLevel level) { return signals::operator_text(level); }

/// Every value of an enumeration without gaps.
template <class Enum>
std::vector<Code> codes() {
  std::vector<Code> list;
  for (std::uint16_t number = 0;; ++number) {
    const std::string_view text = meaning(static_cast<Enum>(number));
    if (text.empty()) return list;
    list.push_back({number, std::string(text)});
  }
}

}  // namespace

std::vector<Code> system_state_codes() { return codes<SystemState>(); }

std::vector<Code> camera_fault_codes() {
  auto list = codes<hal::Fault>();
  list.push_back({kNone, "no such camera is configured"});
  return list;
}

std::vector<Code> quality_codes() {
  std::vector<Code> list;
  for (const Quality quality : {Quality::NotMeasured, Quality::Good, Quality::Apparent}) {
    list.push_back({static_cast<std::uint16_t>(quality), std::string(name_of(quality))});
  }
  return list;
}

std::vector<Code> alarm_state_codes() {
  auto list = codes<signals::AlarmState>();
  list.push_back({kNone, "no such alarm is configured"});
  return list;
}

std::vector<Code> alarm_level_codes() { return codes<signals::AlarmLevel>(); }

std::vector<Code> severity_codes() { return {{0, "none"}, {1, "warning"}, {2, "alarm"}}; }

std::vector<Code> command_codes() {
  std::vector<Code> list{{0, "none"}};
  for (const CommandInfo& command : kCommands) {
    list.push_back({static_cast<std::uint16_t>(command.code), std::string(command.name)});
  }
  return list;
}

std::vector<Code> command_result_codes() { return codes<CommandResult>(); }

std::string listed(const std::vector<Code>& codes) {
  std::string text;
  for (const Code& code : codes) {
    text += (text.empty() ? "" : "; ") + std::to_string(code.number) + " " + code.meaning;
  }
  return text;
}

Quantity range_of(const std::vector<Code>& codes) {
  return {1, "", 0, static_cast<double>(codes.back().number)};
}

}  // namespace orbwatch::app::modbus
