// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>

#include "hal/clock.h"

namespace orbwatch::hal {

/// Maps a camera's clock to the steady clock by a line through moments read from both, despite
/// drift and varying delays between the two; starts anew when the camera's clock was set. Does not
/// allocate. Thread-bound.
class DeviceClock {
 public:
  /// Adds a reading `device` of the camera's clock between two readings of the steady clock.
  void add_latched(std::chrono::nanoseconds device, TimePoint before, TimePoint after);

  /// Adds a frame with the stamp `device` that arrived at `steady`, after a delay of at least an
  /// unknown minimum. The fastest frame of each kBlock counts, so that the line follows arrivals
  /// without the variation of the delays.
  void add_arrival(std::chrono::nanoseconds device, TimePoint steady);

  /// Steady time of `device`; nullopt before the first moment.
  std::optional<TimePoint> to_steady(std::chrono::nanoseconds device) const;

  /// Root mean square distance of the moments from the line; nullopt while fewer than 3 are known.
  std::optional<std::chrono::nanoseconds> residual() const;

  /// Number of moments that the line passes through.
  std::size_t moments() const { return known(); }

  /// Number of times that the camera's clock was found to be set.
  std::size_t jumps() const { return jumps_; }

 private:
  using nanoseconds = std::chrono::nanoseconds;

  struct Moment {
    nanoseconds device{0};
    TimePoint steady;
  };

  static constexpr std::size_t kMoments = 32;
  static constexpr std::chrono::seconds kBlock{1};
  /// A frame ahead of the line by more than kFast, or behind it by more than kSlow, means that the
  /// clock was set.
  static constexpr std::chrono::milliseconds kFast{50};
  static constexpr std::chrono::seconds kSlow{10};
  /// Two successive moments farther from the line than this mean that the clock was set.
  static constexpr std::chrono::milliseconds kStep{20};
  /// Largest drift of a crystal, and of a clock that is being corrected.
  static constexpr double kMostDrift = 500e-6;

  bool continues(const Moment& moment) const;
  void start_anew();
  void add(Moment moment);
  void fit();
  std::size_t known() const { return count_ < kMoments ? count_ : kMoments; }
  /// Delay after the line, ns.
  double lateness(const Moment& moment) const;

  std::array<Moment, kMoments> moments_;  ///< a ring
  std::size_t count_ = 0;                 ///< number of moments ever added
  std::size_t far_ = 0;                   ///< number of the last moments that are beyond kStep
  std::size_t jumps_ = 0;
  bool has_line_ = false;
  Moment origin_;     ///< origin of the line
  double drift_ = 0;  ///< steady time gained per device time
  bool has_block_ = false;
  nanoseconds block_begin_{0};
  Moment fastest_;  ///< fastest frame of the present block
  nanoseconds newest_{0};
};

}  // namespace orbwatch::hal
