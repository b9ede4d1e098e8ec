#pragma once

#include <atomic>
#include <optional>

namespace orbwatch::hal {

/// The state of an input from the machine, for example laser on. Thread-safe.
class ProcessInput {
 public:
  /// Nullopt: not known, as its line has a fault.
  explicit ProcessInput(std::optional<bool> active = {}) : active_(active) {}

  void set(std::optional<bool> active) { active_ = active; }
  std::optional<bool> active() const { return active_; }

 private:
  std::atomic<std::optional<bool>> active_;
};

}  // namespace orbwatch::hal
