// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

#include "proc/signals/signals.h"

namespace orbwatch::signals {

/// Does not compile for a name that no signal has.
consteval std::size_t index_of(std::string_view name) {
  std::size_t index = 0;
  while (kSignals[index].name != name) ++index;
  return index;
}

}  // namespace orbwatch::signals
