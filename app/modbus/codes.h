#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/modbus/register_values.h"

namespace orbwatch::app::modbus {

/// One value of an enumerated register and what it says.
struct Code {
  std::uint16_t number;
  std::string meaning;
};

/// A camera's fault or an alarm's state when there is no such camera or alarm: not 0, which would
/// say that all is well.
inline constexpr std::uint16_t kNone = 0xffff;

/// The values of enumerated registers, ascending. All reentrant.
std::vector<Code> system_state_codes();
std::vector<Code> camera_fault_codes();
std::vector<Code> quality_codes();
std::vector<Code> alarm_state_codes();
std::vector<Code> alarm_level_codes();
std::vector<Code> severity_codes();
std::vector<Code> command_codes();
std::vector<Code> command_result_codes();

/// "0 starting; 1 running": for descriptions.
std::string listed(const std::vector<Code>& codes);

/// From 0 to the last of them.
Quantity range_of(const std::vector<Code>& codes);

}  // namespace orbwatch::app::modbus
