// SPDX-License-Identifier: Apache-2.0
#include "app/model/machine/machine_state.h"

#include <cmath>
#include <string>

namespace orbwatch::app {

Result<> check(const MachineState& state) {
  for (const MachineValue& value : kMachineValues) {
    const double sent = state.values.*value.get;
    if (std::isnan(sent)) continue;
    const ArgumentInfo form{value.name,    value.unit,    value.unit.empty() ? 1 : value.scale,
                            value.minimum, value.maximum, value.description};
    const bool is_whole = !value.unit.empty() || sent == std::floor(sent);
    if (sent >= value.minimum && sent <= value.maximum && is_whole) continue;
    return fail(std::string(value.name) + " is " + std::to_string(sent) + "; it must be " +
                range_text(form));
  }
  if (!std::isnan(state.clock) && !(state.clock >= 0 && state.clock <= kMostClock)) {
    return fail("clock is out of range; it must be 0 to 4294967296 s");
  }
  return {};
}

}  // namespace orbwatch::app
