// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>

namespace orbwatch::app {

/// Handling of validity dates of certificates and permissions. A board without a battery has a
/// wrong clock until a time server is reached.
enum class Dates { Checked, Ignored };

/// Nullopt: dates are not checked.
using Now = std::optional<std::chrono::sys_seconds>;

inline Now now_for(Dates dates) {
  if (dates == Dates::Ignored) return std::nullopt;
  return std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
}

}  // namespace orbwatch::app
