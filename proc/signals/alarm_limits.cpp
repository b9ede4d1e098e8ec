// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/alarm_limits.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <string>

#include "proc/signals/signals.h"

namespace orbwatch::signals {
namespace {

struct NamedLimit {
  const char* name;
  bool high;
  std::optional<double> value;
};

std::array<NamedLimit, kLimits.size()> listed(const AlarmLimits& limits) {
  std::array<NamedLimit, kLimits.size()> all;
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = {kLimits[i].words, kLimits[i].is_high, limits.*kLimits[i].value};
  }
  return all;
}

std::string text(double number) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.10g", number);
  return buffer;
}

std::string text(const NamedLimit& limit) {
  return std::string(limit.name) + " " + text(*limit.value);
}

Result<> check_each(const AlarmLimits& limits) {
  const SignalInfo& signal = kSignals[limits.signal];
  bool any = false;
  for (const NamedLimit& limit : listed(limits)) {
    if (!limit.value) continue;
    any = true;
    if (!(*limit.value >= signal.minimum && *limit.value <= signal.maximum)) {
      return fail(text(limit) + " is not within the signal's range, " + text(signal.minimum) +
                  " to " + text(signal.maximum));
    }
  }
  if (!any) return fail("no limit is set: set at least one");
  return {};
}

/// Checks two limits without another between them.
Result<> check_pair(const NamedLimit& lower, const NamedLimit& upper, double hysteresis) {
  const double gap = *upper.value - *lower.value;
  if (!(gap > 0)) return fail(text(lower) + " is not below " + text(upper));
  const bool two_sides = lower.high != upper.high;
  if (gap > (two_sides ? 2 * hysteresis : hysteresis)) return {};
  return fail("hysteresis " + text(hysteresis) + " is not below " + (two_sides ? "half of " : "") +
              "the gap between " + text(lower) + " and " + text(upper));
}

Result<> check_order(const AlarmLimits& limits) {
  if (!(limits.hysteresis >= 0 && std::isfinite(limits.hysteresis))) {
    return fail("hysteresis " + text(limits.hysteresis) + " is not 0 or more");
  }
  const auto all = listed(limits);
  const NamedLimit* lower = nullptr;
  for (const NamedLimit& limit : all) {
    if (!limit.value) continue;
    if (lower) {
      if (auto checked = check_pair(*lower, limit, limits.hysteresis); !checked) return checked;
    }
    lower = &limit;
  }
  return {};
}

Result<> check_delay(const char* name, std::chrono::nanoseconds delay) {
  if (delay.count() >= 0 && delay <= kLongestDelay) return {};
  using Seconds = std::chrono::duration<double>;
  return fail(std::string(name) + " " + text(Seconds(delay).count()) + " s is not within 0 to " +
              text(Seconds(kLongestDelay).count()) + " s");
}

}  // namespace

Result<> check(const AlarmLimits& limits) {
  if (limits.signal >= kSignals.size()) {
    return fail("signal " + std::to_string(limits.signal) + " does not exist: the last one is " +
                std::to_string(kSignals.size() - 1));
  }
  if (auto checked = check_each(limits); !checked) return checked;
  if (auto checked = check_order(limits); !checked) return checked;
  if (auto checked = check_delay("on delay", limits.on_delay); !checked) return checked;
  if (auto checked = check_delay("off delay", limits.off_delay); !checked) return checked;
  if (!limits.loss_delay) return {};
  return check_delay("loss delay", *limits.loss_delay);
}

}  // namespace orbwatch::signals
