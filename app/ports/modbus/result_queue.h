// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/ports/modbus/map/process_image.h"

namespace orbwatch::app::modbus {

/// Results that wait for the PLC, oldest first: none is lost between two of its scans. A full queue
/// refuses the newest and counts it, so that results that the PLC is reading never change. Fixed
/// memory; thread-bound.
class ResultQueue {
 public:
  static constexpr std::size_t kDepth = kResultQueueDepth;

  void push(const StampedStatus& result) {
    if (status_.count == kDepth) {
      ++status_.overruns;
      status_.overrun = true;
      return;
    }
    results_[(first_ + status_.count++) % kDepth] = result;
  }

  /// Removes the oldest result if `number` equals the lower 32 bits of its number; otherwise does
  /// nothing. So a repeated write, or a PLC that was disconnected, removes no unread result.
  void acknowledge(std::uint32_t number) {
    if (status_.count == 0) return;
    if (number != static_cast<std::uint32_t>(results_[first_].status.result)) return;
    last_acknowledged_ = number;
    first_ = (first_ + 1) % kDepth;
    if (--status_.count == 0) status_.overrun = false;
  }

  const ResultQueueStatus& status() const { return status_; }

  /// The oldest result; number 0: the queue is empty.
  StampedStatus oldest() const { return status_.count > 0 ? results_[first_] : StampedStatus{}; }

  /// Number of the result acknowledged last; 0: none yet.
  std::uint32_t last_acknowledged() const { return last_acknowledged_; }

 private:
  std::array<StampedStatus, kDepth> results_;
  std::size_t first_ = 0;
  ResultQueueStatus status_;
  std::uint32_t last_acknowledged_ = 0;
};

}  // namespace orbwatch::app::modbus
