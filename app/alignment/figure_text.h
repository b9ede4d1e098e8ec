// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <string>

namespace orbwatch::app {

/// "NAME 0.12 UNIT", as a proposal's quality states figures; `unit` may be empty. Reentrant.
inline std::string figure_text(const std::string& name, double value,
                               const std::string& unit = "") {
  char number[32];
  std::snprintf(number, sizeof number, " %.2f", value);
  return name + number + (unit.empty() ? "" : " " + unit);
}

}  // namespace orbwatch::app
