// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>

#include "hal/clock.h"

namespace orbwatch::app::pipeline {

/// Rate and latency over the last full second. Fixed memory; thread-bound.
class SecondMeter {
 public:
  struct Figures {
    double per_second = 0;
    double p50_ms = 0;
    double p99_ms = 0;
  };

  /// Counts one event with its `latency`.
  void add(hal::Clock::duration latency) {
    if (count_ < samples_.size()) {
      samples_[count_] = std::chrono::duration<float, std::milli>(latency).count();
    }
    ++count_;
  }

  /// Returns the figures since the last call, which was `elapsed` ago; starts the next second.
  Figures roll(hal::Clock::duration elapsed) {
    Figures figures;
    figures.per_second =
        static_cast<double>(count_) / std::chrono::duration<double>(elapsed).count();
    const std::size_t kept = std::min(count_, samples_.size());
    figures.p50_ms = percentile(kept, 0.50);
    figures.p99_ms = percentile(kept, 0.99);
    count_ = 0;
    return figures;
  }

  /// Writes them into the members of a CameraStatus or ViewStatus.
  template <class FigureStatus>
  void roll(hal::Clock::duration elapsed, FigureStatus& status) {
    const Figures figures = roll(elapsed);
    status.frames_per_second = figures.per_second;
    status.latency_p50_ms = figures.p50_ms;
    status.latency_p99_ms = figures.p99_ms;
  }

 private:
  /// Nearest rank among the first `kept` samples; 0 without any.
  double percentile(std::size_t kept, double share) {
    if (kept == 0) return 0;
    const auto rank =
        std::min(kept - 1, static_cast<std::size_t>(share * static_cast<double>(kept)));
    const auto at = samples_.begin() + static_cast<std::ptrdiff_t>(rank);
    std::nth_element(samples_.begin(), at, samples_.begin() + static_cast<std::ptrdiff_t>(kept));
    return static_cast<double>(*at);
  }

  std::array<float, 1024> samples_{};  ///< further samples in a second are counted but not ranked
  std::size_t count_ = 0;
};

}  // namespace orbwatch::app::pipeline
