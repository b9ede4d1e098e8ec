#pragma once

#include <cstdint>
#include <vector>

#include "hal/fault.h"

namespace orbwatch::hal {

/// A fault that simulated and replayed cameras are asked to show: from frame `from` (the exposure
/// that first fails) up to, not including, frame `until`. "Unplug at 100, replug at 160" is
/// {Unplugged, 100, 160}.
struct ScriptedFault {
  Fault fault = Fault::None;
  std::uint64_t from = 0;
  std::uint64_t until = 0;
};

/// Faults by exposure number; the first that matches counts.
class FaultScript {
 public:
  FaultScript() = default;
  explicit FaultScript(std::vector<ScriptedFault> faults) : faults_(std::move(faults)) {}

  /// The fault that exposure `sequence` shows, or Fault::None.
  Fault at(std::uint64_t sequence) const {
    for (const auto& entry : faults_) {
      if (sequence >= entry.from && sequence < entry.until) return entry.fault;
    }
    return Fault::None;
  }

 private:
  std::vector<ScriptedFault> faults_;
};

}  // namespace orbwatch::hal
