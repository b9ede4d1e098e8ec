#pragma once

#include <cstdint>

namespace orbwatch::app {

/// Slows display views down while frame sets overrun their deadline, so that measurements keep up:
/// after an overrun display views come half as often, down to every eighth set; after a calm second
/// twice as often again. Thread-bound.
class DisplayThrottle {
 public:
  /// Whether display views are due in frame set `id`.
  bool is_due(std::uint64_t id) const { return id % interval_ == 0; }

  /// Called after each frame set. `calm`: it stayed below half of its deadline.
  void note(bool overran, bool calm, double sets_per_second) {
    if (overran) {
      interval_ = interval_ < kSlowest ? interval_ * 2 : kSlowest;
      calm_sets_ = 0;
    } else if (calm && interval_ > 1 && ++calm_sets_ >= sets_per_second) {
      interval_ /= 2;
      calm_sets_ = 0;
    }
  }

  std::uint64_t interval() const { return interval_; }

 private:
  static constexpr std::uint64_t kSlowest = 8;
  std::uint64_t interval_ = 1;
  double calm_sets_ = 0;
};

}  // namespace orbwatch::app
