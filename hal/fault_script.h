#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "hal/fault.h"
#include "proc/settings/settings.h"

namespace orbwatch::hal {

/// A fault that simulated and replay cameras show: from exposure `from` up to, not including,
/// exposure `until`. "Unplug at 100, replug at 160" is
/// {Unplugged, 100, 160}.
struct ScriptedFault {
  Fault fault = Fault::None;
  std::uint64_t from = 0;
  std::uint64_t until = 0;
};

inline constexpr std::array kFaultWords{
    Word{"unplugged", Fault::Unplugged}, Word{"stalled", Fault::Stalled},
    Word{"read_error", Fault::ReadError}, Word{"corrupt_frame", Fault::CorruptFrame},
    Word{"wrong_format", Fault::WrongFormat}};

template <class Visitor>
void visit(Visitor& v, ScriptedFault& fault) {
  v.required("fault", fault.fault, kFaultWords, "What fails");
  v.required("from", fault.from, Range::between(0, 1e15), "First frame that fails");
  v.required("until", fault.until, Range::between(0, 1e15), "First frame that works again");
}

/// Faults by exposure number; the first match counts.
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
