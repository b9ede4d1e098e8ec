// SPDX-License-Identifier: Apache-2.0
#include "app/ports/lines/safe_state.h"

namespace orbwatch::app {

std::vector<SafeOutput> make_safe(const std::vector<LineSettings>& lines,
                                  hal::LineBackEnd& back_end) {
  std::vector<SafeOutput> outputs;
  for (const LineSettings& line : lines) {
    if (is_input(line.use) || line.back_end != LineKind::Gpio) continue;
    // Opening sets an output inactive.
    const auto opened =
        back_end.open_output({line.wire.address, line.wire.active_low, line.wire.bias});
    outputs.push_back({line.name, opened ? std::string() : opened.error().message});
  }
  return outputs;
}

}  // namespace orbwatch::app
