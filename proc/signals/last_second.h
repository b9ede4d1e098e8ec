// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>

namespace orbwatch::signals {

/// The last second in bins of up to 1/64 s, so that memory is bounded at any frame rate; up to 64
/// frames per second each has its own bin. A default `Bin` is empty. No allocation. Thread-bound.
template <class Bin>
class LastSecond {
 public:
  /// Removes bins a second old or older at `now`, s, which is monotonic.
  void advance(double now) {
    while (size_ > 0 && slots_[first_].last <= now - kSpan) {
      first_ = (first_ + 1) % kCapacity;
      --size_;
    }
  }

  /// The bin of `now`; call after advance(now).
  Bin& at(double now) {
    if (size_ == 0 || now - newest().begin >= kBinWidth) {
      ++size_;
      newest() = {now, now, {}};
    }
    newest().last = now;
    return newest().bin;
  }

  /// Visits bins, the oldest first.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (std::size_t i = 0; i < size_; ++i) visit(slots_[(first_ + i) % kCapacity].bin);
  }

  void clear() { size_ = 0; }

 private:
  static constexpr double kSpan = 1;             // s
  static constexpr double kBinWidth = 1.0 / 64;  // s
  /// Bins begin at least their width apart, and the oldest may have begun before the second did;
  /// one more for rounding.
  static constexpr std::size_t kCapacity = 64 + 3;

  struct Slot {
    double begin = 0;
    double last = 0;
    Bin bin;
  };

  Slot& newest() { return slots_[(first_ + size_ - 1) % kCapacity]; }

  std::array<Slot, kCapacity> slots_{};
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace orbwatch::signals
