#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>

#include "hal/clock.h"

namespace orbwatch::hal {

/// Maps a camera's clock to the steady clock by a line through moments that both have shown, in
/// spite of drift and of delays between the two; starts anew when the camera's clock was set.
/// Without allocation. Thread-bound.
class DeviceClock {
 public:
  /// The camera's clock showed `device` between two readings of the steady clock.
  void add_latched(std::chrono::nanoseconds device, TimePoint before, TimePoint after);

  /// A frame with the stamp `device` arrived at `steady`, late by a delay that is never below some
  /// least one. The fastest frame of each kBlock counts: the line is that of arrivals without what
  /// the delays varied.
  void add_arrival(std::chrono::nanoseconds device, TimePoint steady);

  /// The moment of `device`; nullopt before the first moment.
  std::optional<TimePoint> to_steady(std::chrono::nanoseconds device) const;

  /// Root mean square of how far the moments are from the line; nullopt while fewer than 3 are
  /// known.
  std::optional<std::chrono::nanoseconds> residual() const;

  /// How many moments the line goes through.
  std::size_t moments() const { return known(); }

  /// How often the camera's clock was found set.
  std::size_t jumps() const { return jumps_; }

 private:
  using nanoseconds = std::chrono::nanoseconds;

  struct Moment {
    nanoseconds device{0};
    TimePoint steady;
  };

  static constexpr std::size_t kMoments = 32;
  static constexpr std::chrono::seconds kBlock{1};
  /// No frame is faster than the fastest by this, and none is slower by kSlow.
  static constexpr std::chrono::milliseconds kFast{50};
  static constexpr std::chrono::seconds kSlow{10};
  /// Two moments in a row that are farther from the line are of a clock that was set.
  static constexpr std::chrono::milliseconds kStep{20};
  /// Of any crystal, and of a clock that is being corrected.
  static constexpr double kMostDrift = 500e-6;

  bool continues(const Moment& moment) const;
  void start_anew();
  void add(Moment moment);
  void fit();
  std::size_t known() const { return count_ < kMoments ? count_ : kMoments; }
  /// How much later than the line, ns.
  double lateness(const Moment& moment) const;

  std::array<Moment, kMoments> moments_;  ///< a ring
  std::size_t count_ = 0;                 ///< ever added to it
  std::size_t far_ = 0;                   ///< of the last moments, beyond kStep
  std::size_t jumps_ = 0;
  bool has_line_ = false;
  Moment origin_;     ///< of the line
  double drift_ = 0;  ///< steady time gained per device time
  bool has_block_ = false;
  nanoseconds block_begin_{0};
  Moment fastest_;  ///< of the present block
  nanoseconds newest_{0};
};

}  // namespace orbwatch::hal
