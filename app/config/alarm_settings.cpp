#include "app/config/alarm_settings.h"

#include <algorithm>
#include <string>

#include "proc/signals/signals.h"

namespace orbwatch::app {
namespace {

std::chrono::nanoseconds seconds(double value) {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::duration<double>(value));
}

std::string signal_names() {
  std::string names;
  for (const signals::SignalInfo& signal : signals::kSignals) {
    names += (names.empty() ? "" : ", ") + std::string(signal.name);
  }
  return names;
}

}  // namespace

Result<signals::AlarmLimits> alarm_limits(const AlarmSettings& settings, std::size_t region) {
  const auto found =
      std::ranges::find(signals::kSignals, settings.signal, &signals::SignalInfo::name);
  if (found == signals::kSignals.end()) {
    return fail("there is no signal \"" + settings.signal + "\"; there are: " + signal_names());
  }
  signals::AlarmLimits limits;
  limits.signal = static_cast<std::size_t>(found - signals::kSignals.begin());
  limits.region = region;
  limits.low_alarm = settings.low_alarm;
  limits.low_warning = settings.low_warning;
  limits.high_warning = settings.high_warning;
  limits.high_alarm = settings.high_alarm;
  limits.hysteresis = settings.hysteresis;
  limits.on_delay = seconds(settings.on_delay);
  limits.off_delay = seconds(settings.off_delay);
  limits.loss_delay.reset();
  if (settings.loss_delay > 0) limits.loss_delay = seconds(settings.loss_delay);
  limits.latching = settings.latching;
  limits.only_while_active = settings.only_while_active;
  return limits;
}

}  // namespace orbwatch::app
