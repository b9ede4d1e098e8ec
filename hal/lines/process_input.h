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
    const State next = !active ? State::Unknown : *active ? State::Active : State::Inactive;
    if (state_.exchange(next) == State::Inactive && next == State::Active) ++edges_;
  }
  std::optional<bool> active() const {
    const State state = state_;
    if (state == State::Unknown) return std::nullopt;
    return state == State::Active;
  }
  /// Changes from inactive to active so far, also those between two calls of active(). An
  /// input that becomes known makes no edge.
  std::uint32_t edges() const { return edges_; }

 private:
  /// An optional would not do: not every compiler reads one without a lock.
  enum class State : std::uint8_t { Unknown, Inactive, Active };
  std::atomic<State> state_{State::Unknown};
  std::atomic<std::uint32_t> edges_{0};
};

}  // namespace orbwatch::hal
