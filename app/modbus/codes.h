#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace orbwatch::app::modbus {

/// One value of an enumerated register and what it says.
struct Code {
  std::uint16_t number;
  std::string meaning;
};

/// A camera's fault register when there is no such camera: not 0, which would say that it delivers.
inline constexpr std::uint16_t kNoCamera = 0xffff;

/// The values of enumerated registers, ascending. All reentrant.
std::vector<Code> system_state_codes();
std::vector<Code> camera_fault_codes();
std::vector<Code> command_codes();
std::vector<Code> command_result_codes();

/// "0 starting; 1 running": for descriptions.
std::string listed(const std::vector<Code>& codes);

}  // namespace orbwatch::app::modbus
