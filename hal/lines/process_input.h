#pragma once

#include <cstdint>
#include <mutex>

#include "hal/lines/line.h"

namespace orbwatch::hal {

/// The state of an input from the machine, for example laser on. Thread-safe.
class ProcessInput {
 public:
  struct State {
    bool active = false;
    TimePoint since;          ///< of the newest edge, else of opening
    std::uint64_t edges = 0;  ///< since opening
  };

  ProcessInput(bool active, TimePoint now) : state_{active, now, 0} {}

  /// An edge of the line.
  void on_edge(const EdgeEvent& edge) {
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
