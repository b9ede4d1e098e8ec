// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

namespace orbwatch::hal {

/// State of an input from the machine, for example laser on. Thread-safe.
class ProcessInput {
 public:
  /// Nullopt: unknown, because its line has a fault.
  explicit ProcessInput(std::optional<bool> active = {}) { set(active); }

  void set(std::optional<bool> active) {
    state_ = !active ? State::Unknown : *active ? State::Active : State::Inactive;
  }
  std::optional<bool> active() const {
    const State state = state_;
    if (state == State::Unknown) return std::nullopt;
    return state == State::Active;
  }

 private:
  /// An optional would not do: not every compiler reads one without a lock.
  enum class State : std::uint8_t { Unknown, Inactive, Active };
  std::atomic<State> state_;
};

}  // namespace orbwatch::hal
