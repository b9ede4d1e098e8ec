// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <optional>
#include <string>

namespace orbwatch::app {

/// A moment in ISO 8601 with nanoseconds: "2026-11-21T20:57:46.000000000Z"; nullopt for the epoch,
/// which stands for "never". Reentrant.
std::optional<std::string> utc_text(std::chrono::system_clock::time_point moment);

}  // namespace orbwatch::app
