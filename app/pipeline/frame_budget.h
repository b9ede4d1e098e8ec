// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <utility>

#include "hal/clock.h"

namespace orbwatch::app::pipeline {

/// Processing time allowed per frame set, and the reaction to an overrun: display views slow down,
/// so that measurements keep up. After an overrun they are due half as often, down to every eighth
/// set; after a second of low load twice as often again. Thread-bound.
class FrameBudget {
 public:
  /// `deadline` is above 0.
  explicit FrameBudget(hal::Clock::duration deadline) : deadline_(deadline) {}

  /// Applies to the following sets.
  void set_deadline(hal::Clock::duration deadline) { deadline_ = deadline; }

  /// True if display views are due in frame set `id`.
  bool is_display_due(std::uint64_t id) const { return id % interval_ == 0; }
  std::uint64_t interval() const { return interval_; }

  /// Call after each frame set; `spent` is its processing time. Returns true for an overrun.
  bool add(hal::Clock::duration spent) {
    const double load = seconds(spent) / seconds(deadline_);
    largest_load_ = std::max(largest_load_, load);
    const bool is_overrun = load > 1;
    if (is_overrun) {
      ++overruns_;
      interval_ = std::min(interval_ * 2, kSlowest);
      calm_seconds_ = 0;
    } else if (load < kCalm && interval_ > 1) {
      calm_seconds_ += seconds(deadline_);
      if (calm_seconds_ >= 1 - kRounding) {
        interval_ /= 2;
        calm_seconds_ = 0;
      }
    }
    return is_overrun;
  }

  std::uint64_t overruns() const { return overruns_; }

  /// Returns the largest share of the deadline since the last call.
  double roll_load() { return std::exchange(largest_load_, 0); }

 private:
  static constexpr std::uint64_t kSlowest = 8;
  static constexpr double kCalm = 0.5;
  static constexpr double kRounding = 1e-6;  ///< s, rounding error of a sum of deadlines

  static double seconds(hal::Clock::duration time) {
    return std::chrono::duration<double>(time).count();
  }

  hal::Clock::duration deadline_;
  std::uint64_t interval_ = 1;
  double calm_seconds_ = 0;
  double largest_load_ = 0;
  std::uint64_t overruns_ = 0;
};

}  // namespace orbwatch::app::pipeline
