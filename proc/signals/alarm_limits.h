#pragma once

#include <chrono>
#include <cstddef>
#include <optional>

#include "proc/image/result.h"

namespace orbwatch::signals {

/// The limits of one signal in one region, and how they are watched. Values in the signal's unit.
struct AlarmLimits {
  std::size_t signal = 0;  ///< index in kSignals
  std::size_t region = 0;
  std::optional<double> low_alarm;
  std::optional<double> low_warning;
  std::optional<double> high_warning;
  std::optional<double> high_alarm;
  double hysteresis = 0;  ///< how far the value must come back from a limit to end what it began
  std::chrono::nanoseconds on_delay{0};   ///< a limit counts once it was reached for so long
  std::chrono::nanoseconds off_delay{0};  ///< and until the value was back for so long
  /// Not measured for so long is a condition of its own. Nothing: never, what stands is only held.
  std::optional<std::chrono::nanoseconds> loss_delay = std::chrono::seconds(1);
  bool latching = false;  ///< stands, at its worst level, until acknowledged without its cause
  bool only_while_active = true;  ///< suppressed while the process is not active
};

inline constexpr std::chrono::nanoseconds kLongestDelay = std::chrono::hours(1);

/// Errors: no limit at all; limits that are not finite, outside the signal's range or not in the
/// order low alarm < low warning < high warning < high alarm; a hysteresis that is negative, that
/// spans the gap between two limits of one side, or that leaves no value at which both sides end; a
/// delay that is negative or above kLongestDelay; no such signal. Reentrant.
Result<> check(const AlarmLimits& limits);

}  // namespace orbwatch::signals
