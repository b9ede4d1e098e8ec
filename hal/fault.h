// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <tl/expected.hpp>
#include <utility>
#include <vector>

#include "proc/image/result.h"
#include "proc/settings/settings.h"

namespace orbwatch::hal {

/// The faults of a running camera. PLCs read the numbers (Modbus) and controllers receive them
/// (DDS): append, never renumber.
enum class Fault : std::uint8_t {
  None = 0,
  Unplugged = 1,
  Stalled = 2,
  ReadError = 3,
  CorruptFrame = 4,
  WrongFormat = 5,
  Refused = 6,
  NoTimeStamps = 7,
};

/// The operator's text for each fault, declared only here. Empty for an unknown number.
constexpr std::string_view operator_text(Fault fault) {
  switch (fault) {
    case Fault::None:
      return "camera delivers";
    case Fault::Unplugged:
      return "camera is not connected, or cannot be opened";
    case Fault::Stalled:
      return "camera sends no frames";
    case Fault::ReadError:
      return "camera reports a read error";
    case Fault::CorruptFrame:
      return "camera sends damaged frames";
    case Fault::WrongFormat:
      return "camera sends another format than configured";
    case Fault::Refused:
      return "camera refuses its settings";
    case Fault::NoTimeStamps:
      return "camera gives no time stamps, which triggers and joined cameras need";
  }
  return {};
}

/// The word for each fault in files and in the log, declared only here; empty for an unknown one.
constexpr std::string_view word(Fault fault) {
  switch (fault) {
    case Fault::None:
      return "";
    case Fault::Unplugged:
      return "unplugged";
    case Fault::Stalled:
      return "stalled";
    case Fault::ReadError:
      return "read_error";
    case Fault::CorruptFrame:
      return "corrupt_frame";
    case Fault::WrongFormat:
      return "wrong_format";
    case Fault::Refused:
      return "refused";
    case Fault::NoTimeStamps:
      return "no_time_stamps";
  }
  return {};
}

/// Change of a camera's state. Fault::None: it delivers again.
struct FaultReport {
  Fault fault = Fault::None;
  std::string detail;  ///< device and system message; may be empty
};

/// Value from a device, or the fault to report.
template <class T = void>
using DeviceResult = tl::expected<T, FaultReport>;

using orbwatch::fail;

/// `return fail(fault, "...")` from a function that returns a DeviceResult.
inline tl::unexpected<FaultReport> fail(Fault fault, std::string detail) {
  return tl::unexpected(FaultReport{fault, std::move(detail)});
}

/// Fault that simulated and replay cameras show from exposure `from` up to, not including, exposure
/// `until`. "Unplug at 100, replug at 160" is {Unplugged, 100, 160}.
struct ScriptedFault {
  Fault fault = Fault::None;
  std::uint64_t from = 0;
  std::uint64_t until = 0;
};

/// Faults that a script may have.
inline constexpr auto kFaultWords = [] {
  constexpr std::array kScripted{Fault::Unplugged, Fault::Stalled, Fault::ReadError,
                                 Fault::CorruptFrame, Fault::WrongFormat};
  std::array<Word<Fault>, kScripted.size()> words{};
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = {word(kScripted[i]), kScripted[i]};
  return words;
}();

template <class Visitor>
void visit(Visitor& v, ScriptedFault& fault) {
  v.required("fault", fault.fault, kFaultWords, "Fault that is simulated");
  v.required("from", fault.from, Range::between(0, 1e15), "First frame that fails");
  v.required("until", fault.until, Range::between(0, 1e15), "First frame without the fault");
}

/// Faults by exposure number; the first match counts.
class FaultScript {
 public:
  FaultScript() = default;
  explicit FaultScript(std::vector<ScriptedFault> faults) : faults_(std::move(faults)) {}

  /// Fault that exposure `sequence` shows, or Fault::None.
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
