// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "app/machine/state_track.h"

namespace orbwatch::app::machine {

/// Comparison of the triggers that a controller counts with the edges that are counted here. The
/// difference of both counts is the same for all frame sets; the states around an exposure bound
/// it. A set whose bounds leave no common difference with the sets before is associated with the
/// wrong states, by a frame or more. Thread-bound.
class TriggerAgreement {
 public:
  /// Adds the frame set of edge `trigger`, exposed at `moment`, and judges the sets that have a
  /// state after them. Returns the number of sets that contradict those before; the comparison
  /// then begins anew.
  int slips(const StateTrack& track, std::uint64_t trigger, hal::TimePoint moment);

 private:
  struct Set {
    std::uint64_t trigger = 0;
    hal::TimePoint moment{};
  };

  bool slips(const StateTrack& track, const Set& set);

  /// States closer to the exposure do not bound the count: their moments are that uncertain.
  static constexpr std::chrono::milliseconds kUncertainty{5};
  static constexpr double kNoBound = std::numeric_limits<double>::infinity();
  static constexpr std::size_t kMostWaiting = 32;  ///< half a second of 60 sets a second

  std::array<Set, kMostWaiting> waiting_{};  ///< oldest first
  std::size_t waiting_count_ = 0;
  double low_ = -kNoBound;  ///< of the controller's count minus the own one
  double high_ = kNoBound;
};

}  // namespace orbwatch::app::machine
