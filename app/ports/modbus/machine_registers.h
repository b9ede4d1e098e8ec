// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "app/model/machine/machine_state.h"
#include "app/ports/modbus/map/process_image.h"
#include "app/ports/modbus/server/request.h"

namespace orbwatch::app::modbus {

/// The state in the registers, its values in their units, unchecked. Errors: the name of the part,
/// or the microseconds of the clock. Reentrant.
Result<MachineState> machine_state_in(const MachineRegisters& registers);

/// Hands over the state of a checked write, whose values are checked here, so that each refusal is
/// counted. Refusals: IllegalDataAddress, Modbus is not the source; IllegalDataValue, the state is
/// refused. Thread-safe.
std::optional<Exception> take_machine_state(const Write& write, const RegisterMap& map,
                                            const MachinePath& path);

}  // namespace orbwatch::app::modbus
