// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/pulse_output.h"

#include <utility>

namespace orbwatch::hal {

PulseOutput::PulseOutput(const PulseSettings& settings, Outputs outputs, std::function<void()> wake)
    : settings_(settings),
      wake_(std::move(wake)),
      outputs_(std::move(outputs)),
      rise_(settings.period.count() > 0 ? TimePoint::min() : TimePoint::max()) {}

bool PulseOutput::fire(TimePoint moment) {
  {
    const std::lock_guard lock(mutex_);
    if (active_ || rise_ != TimePoint::max()) {
      ++counts_.missed;
      return false;
    }
    rise_ = moment + settings_.delay;
  }
  wake_();
  return true;
}

TimePoint PulseOutput::due() const {
  const std::lock_guard lock(mutex_);
  return active_ ? fall_ : rise_;
}

void PulseOutput::run(TimePoint now) {
  schedule(now);
  if (driven_ == active_) return;
  driven_ = active_;
  // Counted without the lock, so that fire() does not wait for a line.
  std::uint64_t failed = 0;
  for (const auto& output : outputs_) failed += output->set(driven_) ? 0 : 1;
  const std::lock_guard lock(mutex_);
  counts_.failed += failed;
}

void PulseOutput::schedule(TimePoint now) {
  const std::lock_guard lock(mutex_);
  if (rise_ == TimePoint::min()) rise_ = now + settings_.delay;
  if (active_) {
    active_ = now < fall_;
  } else if (now >= rise_) {
    begin_pulse(now);
  }
}

void PulseOutput::begin_pulse(TimePoint now) {
  active_ = true;
  ++counts_.pulses;
  fall_ = now + settings_.width;
  if (settings_.period.count() <= 0) {
    rise_ = TimePoint::max();
    return;
  }
  const auto late = (now - rise_) / settings_.period;
  counts_.missed += static_cast<std::uint64_t>(late);
  rise_ += (late + 1) * settings_.period;
}

PulseCounts PulseOutput::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

}  // namespace orbwatch::hal
