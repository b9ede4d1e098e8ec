// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/machine_registers.h"

#include <string>

namespace orbwatch::app::modbus {
namespace {

Result<PartName> part_in(const MachineRegisters& registers) {
  std::string text;
  for (const std::uint16_t word : registers.part) {
    text += static_cast<char>(word >> 8);
    text += static_cast<char>(word & 0xff);
  }
  text.resize(text.find_last_not_of('\0') + 1);
  return PartName::make(text);
}

/// The controller's clock, s; NaN: it sends none.
Result<double> clock_in(const MachineRegisters& registers) {
  if (registers.clock_microseconds > 999999) {
    return fail("clock_microseconds is " + std::to_string(registers.clock_microseconds) +
                "; it must be a whole number, 0 to 999999");
  }
  if (registers.clock_seconds == MachineRegisters::kNoClock) return signals::kNotValid;
  return registers.clock_seconds + 1e-6 * registers.clock_microseconds;
}

}  // namespace

Result<MachineState> machine_state_in(const MachineRegisters& registers) {
  const auto part = part_in(registers);
  if (!part) return tl::unexpected(part.error());
  const auto clock = clock_in(registers);
  if (!clock) return tl::unexpected(clock.error());
  MachineState state{.sequence = registers.sequence, .clock = *clock, .part = *part};
  for (std::size_t i = 0; i < kMachineValues.size(); ++i) {
    const std::int32_t value = registers.values[i];
    if (value == MachineRegisters::kUnknown) continue;
    state.values.*kMachineValues[i].get = value * kMachineValues[i].scale;
  }
  return state;
}

std::optional<Exception> take_machine_state(const Write& write, const RegisterMap& map,
                                            const MachinePath& path) {
  if (path.source != MachineSource::Modbus) return Exception::IllegalDataAddress;
  PlcRegisters written;
  apply(write, map, written);
  if (!path.take(machine_state_in(written.machine))) return Exception::IllegalDataValue;
  return std::nullopt;
}

}  // namespace orbwatch::app::modbus
