// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/machine_registers.h"

#include <string>

namespace orbwatch::app::modbus {

Result<MachineState> machine_state_in(const MachineRegisters& registers) {
  std::string text;
  for (const std::uint16_t word : registers.part) {
    text += static_cast<char>(word >> 8);
    text += static_cast<char>(word & 0xff);
  }
  text.resize(text.find_last_not_of('\0') + 1);
  const auto part = PartName::make(text);
  if (!part) return tl::unexpected(part.error());
  MachineState state{.sequence = registers.sequence, .part = *part};
  if (registers.clock_seconds != MachineRegisters::kNoClock) {
    state.clock = registers.clock_seconds + 1e-6 * registers.clock_microseconds;
  }
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
  if (!machine_state_in(written.machine).and_then(path.handler)) {
    return Exception::IllegalDataValue;
  }
  return std::nullopt;
}

}  // namespace orbwatch::app::modbus
