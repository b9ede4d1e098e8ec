#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "app/modbus/snapshot.h"

namespace orbwatch::app::modbus {

/// Results that wait for the PLC, oldest first, so that none is lost between two of its scans. When
/// it is full the newest is refused and counted: those that wait stay what they are, whenever the
/// PLC reads them. Fixed memory; thread-bound.
class ResultQueue {
 public:
  static constexpr std::size_t kDepth = 8;

  void push(const Moment& result) {
    if (count_ == kDepth) {
      ++refused_;
      any_refused_ = true;
      return;
    }
    results_[(first_ + count_++) % kDepth] = result;
  }

  /// Removes the oldest when that is its number, cut to 32 bits; otherwise nothing happens. So
  /// repeating it, or a PLC that has slept, takes no result away that was not read.
  void take(std::uint32_t number) {
    if (count_ == 0 || number != static_cast<std::uint32_t>(results_[first_].status.result)) return;
    last_taken_ = number;
    first_ = (first_ + 1) % kDepth;
    if (--count_ == 0) any_refused_ = false;
  }

  WaitingResults waiting() const {
    WaitingResults waiting{.count = count_,
                           .refused = refused_,
                           .any_refused = any_refused_,
                           .last_taken = last_taken_};
    if (count_ > 0) waiting.oldest = results_[first_];
    return waiting;
  }

 private:
  std::array<Moment, kDepth> results_;
  std::size_t first_ = 0;
  std::size_t count_ = 0;
  std::uint64_t refused_ = 0;
  bool any_refused_ = false;
  std::uint32_t last_taken_ = 0;
};

}  // namespace orbwatch::app::modbus
