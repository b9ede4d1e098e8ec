// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "app/model/status/health.h"

namespace orbwatch::app {

/// Reads every source of throttling: the Raspberry Pi's firmware and supply monitor, cooling
/// devices that throttle processors (most arm boards), the counters of x86 processors.
/// Thread-bound.
class ThrottlingMonitor {
 public:
  /// `sys` is the mount point of sysfs.
  explicit ThrottlingMonitor(std::filesystem::path sys) : sys_(std::move(sys)) {}

  /// Reads the bits; nullopt when the board has no source.
  std::optional<std::uint8_t> read();

 private:
  std::filesystem::path sys_;
  unsigned since_power_on_ = 0;
  std::optional<std::int64_t> events_;  ///< x86 counters at the last reading
};

}  // namespace orbwatch::app
