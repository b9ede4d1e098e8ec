// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>

#include "hal/clock.h"
#include "hal/genicam/device/aravis.h"

namespace orbwatch::hal {

/// Reads a camera's clock: SFNC's TimestampLatch, or GevTimestampControlLatch of older GigE Vision
/// cameras. The camera outlives it. Call under the lock of the camera's features.
class TimestampLatch {
 public:
  struct Reading {
    std::chrono::nanoseconds device;  ///< camera's time, latched between `before` and `after`
    TimePoint before, after;
  };

  /// Nullopt: the camera has no latch.
  static std::optional<TimestampLatch> find(ArvCamera* camera);

  /// Nullopt: the camera did not answer.
  std::optional<Reading> read() const;

 private:
  struct Names {
    const char* command;
    const char* value;
    bool in_ticks;  ///< readings count ticks of the camera's frequency, else ns
  };

  TimestampLatch(ArvDevice* device, const Names& names, std::uint64_t frequency)
      : device_(device), names_(names), frequency_(frequency) {}

  ArvDevice* device_;
  Names names_;
  std::uint64_t frequency_;  ///< units of the readings per second
};

}  // namespace orbwatch::hal
