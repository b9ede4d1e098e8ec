// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bitset>
#include <chrono>
#include <cstddef>
#include <span>

#include "proc/image/result.h"
#include "proc/signals/alarm.h"
#include "proc/signals/signals.h"

namespace orbwatch::signals {

inline constexpr std::size_t kMaxAlarms = 32;

/// A set of a board's alarms, by index.
using AlarmSet = std::bitset<kMaxAlarms>;

/// A set of regions, by index.
using RegionSet = std::bitset<kMaxRegions>;

/// An event of one alarm at one step.
struct AlarmEvent {
  std::size_t alarm = 0;  ///< index on the board
  AlarmEventKind kind = AlarmEventKind::Raised;
  AlarmState state = AlarmState::Normal;  ///< state after the event
  /// The level that it was raised or eased to; else the worst one acknowledged, cleared or
  /// suppressed.
  AlarmLevel level = AlarmLevel::None;
  double value = kNotValid;  ///< the signal's value at this step; not finite: not measured
  std::chrono::nanoseconds time{0};
};

/// The inputs of one step.
struct AlarmBoardInputs {
  std::chrono::nanoseconds now{0};   ///< see AlarmInputs
  std::span<const Signals> regions;  ///< signals of each region; beyond the end: not measured
  bool process_active = true;
  AlarmSet acknowledged;  ///< alarms acknowledged since the last step; indices beyond the board are
                          ///< ignored
  RegionSet stale{};      ///< regions that were not measured anew since the last step
};

/// The alarms of one recipe. The size is fixed, so stepping allocates nothing. Thread-bound.
class AlarmBoard {
 public:
  /// A board without alarms.
  AlarmBoard() = default;

  /// Errors: more than kMaxAlarms; a region of `region_count` or above; limits that do not pass
  /// check(). They name the alarm by its place in the list, from 0, and its signal.
  static Result<AlarmBoard> make(std::span<const AlarmLimits> limits, std::size_t region_count);

  /// Acknowledges, then steps every alarm. Returns the events in the order of alarms, an
  /// acknowledgement first; valid until the next step or the end of the board.
  std::span<const AlarmEvent> step(const AlarmBoardInputs& inputs);

  std::size_t size() const { return size_; }
  /// Precondition: `index` is below size().
  const AlarmLimits& limits(std::size_t index) const { return limits_[index]; }
  const Alarm& alarm(std::size_t index) const { return memories_[index].alarm; }

 private:
  void acknowledge(std::size_t index, const AlarmInputs& now);
  void step(std::size_t index, const AlarmInputs& now);
  void record(std::size_t index, AlarmEventKind kind, AlarmLevel level, const AlarmInputs& now);

  std::size_t size_ = 0;
  std::array<AlarmLimits, kMaxAlarms> limits_;
  std::array<AlarmMemory, kMaxAlarms> memories_;
  std::size_t event_count_ = 0;
  std::array<AlarmEvent, 2 * kMaxAlarms> events_;  ///< two per alarm: acknowledged, then changed
};

}  // namespace orbwatch::signals
