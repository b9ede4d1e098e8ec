// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "app/model/machine/machine_status.h"
#include "hal/clock.h"
#include "proc/optics/vec.h"

namespace orbwatch::app::machine {

/// A state at its moment, in the machine frame of the rig.
struct TimedState {
  hal::TimePoint moment{};
  PartName part;
  MachineValues values;
  optics::Vec3 tool;  ///< direction of the tool, unit length
};

/// The newest states by their moments, and what they say about a moment between them. No
/// allocation once it is made, no trigonometry. Thread-bound.
class StateTrack {
 public:
  /// States kept: two seconds of a controller that sends 250 a second.
  static constexpr std::size_t kCapacity = 512;

  /// `timeout`: the longest time between two states, or after the arrival of the last one, for
  /// which values are known. `delay`: from a state's moment to its arrival.
  explicit StateTrack(hal::Clock::duration timeout, hal::Clock::duration delay = {})
      : timeout_(timeout), silence_(timeout + delay), states_(kCapacity) {}

  /// Adds the newest state. Kept states that are later, whose moments were estimated too late, are
  /// discarded.
  void add(const TimedState& state);

  /// True: no state arrived within the timeout before `now`, or none at all.
  bool is_silent(hal::TimePoint now) const;

  /// Sets quality, state, part, values and motion at `moment`; what is not known is not valid.
  void report(hal::TimePoint moment, MachineStatus& machine) const;

  /// The newest state at or before `moment`, and the oldest one after it; null: not kept.
  const TimedState* before(hal::TimePoint moment) const;
  const TimedState* after(hal::TimePoint moment) const;

 private:
  /// Number of kept states at or before `moment`.
  std::size_t count_until(hal::TimePoint moment) const;
  /// State `n` of the kept ones, 0 the oldest.
  const TimedState& at(std::size_t n) const { return states_[(first_ + n) % kCapacity]; }

  const hal::Clock::duration timeout_;
  const hal::Clock::duration silence_;  ///< from the last state's moment until it is too old
  std::vector<TimedState> states_;      ///< ring
  std::size_t first_ = 0;
  std::size_t size_ = 0;
};

}  // namespace orbwatch::app::machine
