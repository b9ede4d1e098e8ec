// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <optional>
#include <string_view>

#include "proc/image/result.h"
#include "proc/settings/settings.h"
#include "proc/signals/signals.h"

namespace orbwatch::signals {

/// The limits of one signal in one region, and the delays and hysteresis for them. Values in the
/// signal's unit.
struct AlarmLimits {
  std::size_t signal = 0;  ///< index in kSignals
  std::size_t region = 0;
  std::optional<double> low_alarm;
  std::optional<double> low_warning;
  std::optional<double> high_warning;
  std::optional<double> high_alarm;
  double hysteresis = 0;                  ///< distance back from a limit that ends its condition
  std::chrono::nanoseconds on_delay{0};   ///< time at the limit before a condition begins
  std::chrono::nanoseconds off_delay{0};  ///< time back from the limit before it ends
  /// Time without a measurement that is a condition of its own. nullopt: never; the state is held.
  std::optional<std::chrono::nanoseconds> loss_delay = std::chrono::seconds(1);
  /// Stays, at its worst level, until acknowledged after its condition ended.
  bool latching = false;
  bool only_while_active = true;  ///< suppressed while the process is not active
};

/// One of the limits that a signal can reach.
struct LimitInfo {
  const char* name;   ///< name of its key
  const char* words;  ///< text for messages
  bool is_high;       ///< reached from below
  std::optional<double> AlarmLimits::*value;
};

/// Sorted from low to high.
inline constexpr std::array kLimits{
    LimitInfo{"low_alarm", "low alarm", false, &AlarmLimits::low_alarm},
    LimitInfo{"low_warning", "low warning", false, &AlarmLimits::low_warning},
    LimitInfo{"high_warning", "high warning", true, &AlarmLimits::high_warning},
    LimitInfo{"high_alarm", "high alarm", true, &AlarmLimits::high_alarm}};

/// Name of the key for the distance back from a limit that ends its condition.
inline constexpr const char* kHysteresis = "hysteresis";

inline constexpr std::chrono::nanoseconds kLongestDelay = std::chrono::hours(1);

/// Every signal's name and index.
inline constexpr auto kSignalWords = [] {
  std::array<Word<std::size_t>, kSignals.size()> words{};
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = {kSignals[i].name, i};
  return words;
}();

/// Visits all keys except the region, whose table contains the limits.
template <class Visitor>
void visit(Visitor& v, AlarmLimits& limits) {
  const Seconds delay{Range::between(0, std::chrono::duration<double>(kLongestDelay).count())};
  v.required("signal", limits.signal, kSignalWords, "Signal that is supervised");
  for (const LimitInfo& limit : kLimits) {
    v.optional(limit.name, limits.*limit.value, kAnyNumber, "Limit in the signal's unit");
  }
  v.optional(kHysteresis, limits.hysteresis, Range::between(0, 1e9),
             "Distance from the limit at which the alarm ends, in the signal's unit");
  v.optional("on_delay", limits.on_delay, delay,
             "Time for which a limit must be exceeded to raise the alarm, s");
  v.optional("off_delay", limits.off_delay, delay,
             "Time for which the signal must be back to end the alarm, s");
  v.optional("loss_delay", limits.loss_delay, delay,
             "Time without a measurement after which an alarm is raised, s; 0: never");
  if (limits.loss_delay == std::chrono::nanoseconds::zero()) limits.loss_delay.reset();
  v.optional("latching", limits.latching,
             "The alarm stays active until it is acknowledged, even after its cause has gone");
  v.optional("only_while_active", limits.only_while_active,
             "The alarm is suppressed while the process is not active");
}

/// Errors: no limit at all; limits that are not finite, outside the signal's range or not in the
/// order low alarm < low warning < high warning < high alarm; a hysteresis that is negative, that
/// spans the gap between two limits of one side, or that leaves no value at which both sides end; a
/// delay that is negative or above kLongestDelay; no such signal. Reentrant.
Result<> check(const AlarmLimits& limits);

}  // namespace orbwatch::signals
