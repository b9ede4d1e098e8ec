// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "app/model/status/status_report.h"

namespace orbwatch::app::tests {

inline constexpr std::uint16_t kRecipe = 7;

inline StatusNames make_names() {
  return {{"colour", "thermal"}, {"front", "wide"}, {{kRecipe, {"weld", "edge"}}}};
}

/// Distinct numbers that a double represents exactly.
class Numbers {
 public:
  std::uint64_t whole() { return next_++; }
  double real() { return static_cast<double>(next_++) + 0.125; }

 private:
  std::uint64_t next_ = 1'000'000'000'000;
};

inline CameraStatus make_camera(Numbers& numbers) {
  CameraStatus camera;
  camera.fault = hal::Fault::Stalled;
  camera.frames = numbers.whole();
  camera.lost = numbers.whole();
  camera.dropped = numbers.whole();
  camera.unmatched = numbers.whole();
  camera.frames_per_second = numbers.real();
  camera.latency_p50_ms = numbers.real();
  camera.latency_p99_ms = numbers.real();
  camera.triggers = numbers.whole();
  camera.missed = numbers.whole();
  camera.damaged = numbers.whole();
  camera.flawed = numbers.whole();
  camera.alignment = AlignmentLevel::Good;
  camera.drift_error = numbers.real();
  camera.drift_shift = numbers.real();
  camera.blur = numbers.real();
  camera.contamination = numbers.real();
  return camera;
}

inline AlarmStatus make_alarm(std::size_t index, Numbers& numbers) {
  AlarmStatus alarm;
  alarm.alarm = {signals::AlarmState::LatchedUnacknowledged, signals::AlarmLevel::HighWarning,
                 signals::AlarmLevel::HighAlarm, index % 2 == 0};
  alarm.region = index % 2;
  alarm.signal = static_cast<SignalNumber>(index);
  alarm.value = numbers.real();
  return alarm;
}

/// A status whose figures all differ, with the names of make_names().
inline Status make_status() {
  Numbers numbers;
  Status status;
  status.state = SystemState::Degraded;
  status.heartbeat = numbers.whole();
  status.frame_set = numbers.whole();
  status.stamp = hal::Clock::now();
  status.trigger = numbers.whole();
  status.result = numbers.whole();
  status.recipe = kRecipe;
  status.configuration_checksum = 0xdeadbeef;
  status.recipe_refused = true;
  status.process_active = true;
  status.overruns = numbers.whole();
  status.unmatched = numbers.whole();
  status.skew_ms = numbers.real();
  status.load = numbers.real();
  status.process_inputs = 0x80000005;
  status.selected_view = 1;
  status.camera_count = 2;
  for (auto& camera : status.cameras) camera = make_camera(numbers);
  status.view_count = 2;
  for (auto& view : status.views) {
    view = {numbers.whole(), numbers.whole(), numbers.whole(),
            numbers.real(),  numbers.real(),  numbers.real()};
  }
  status.region_count = 2;
  for (auto& region : status.regions) {
    region.quality = Quality::Apparent;
    for (const auto& signal : signals::kSignals) region.signals.*signal.member = numbers.real();
  }
  status.alarm_count = 3;
  for (std::size_t i = 0; i < status.alarm_count; ++i) status.alarms[i] = make_alarm(i, numbers);
  for (const auto& figure : kHealthFigures) status.health.*figure.get = numbers.real();
  return status;
}

}  // namespace orbwatch::app::tests
