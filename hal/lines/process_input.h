#pragma once

#include <cstdint>
#include <mutex>

#include "hal/lines/line.h"

namespace orbwatch::hal {

/// What an input of the machine says, laser on for one. Thread-safe.
class ProcessInput {
 public:
  struct State {
    bool active = false;
    TimePoint since;          ///< the edge; or when the line was opened
    std::uint64_t edges = 0;  ///< since then
  };

  ProcessInput(bool active, TimePoint now) : state_{active, now, 0} {}

  /// An edge of the line.
  void take(const EdgeEvent& edge) {
    const std::lock_guard lock(mutex_);
    state_ = {edge.edge == Edge::Rising, edge.stamp, state_.edges + 1};
  }

  State state() const {
    const std::lock_guard lock(mutex_);
    return state_;
  }

 private:
  mutable std::mutex mutex_;
  State state_;
};

}  // namespace orbwatch::hal
