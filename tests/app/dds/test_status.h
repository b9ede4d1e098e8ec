#pragma once

#include "app/pipeline/status.h"

namespace orbwatch::app::tests {

/// A status in which no two figures are equal.
inline Status make_status() {
  Status status;
  status.state = SystemState::Degraded;
  status.heartbeat = 1'000'000'000'001;
  status.frame_set = 1'000'000'000'002;
  status.stamp = hal::Clock::now();
  status.overruns = 3;
  status.unmatched = 4;
  status.trigger = 1'000'000'000'003;
  status.skew_ms = 0.375;
  status.load = 0.625;
  status.selected_view = 1;
  status.process_inputs = 0b101;
  status.camera_count = 2;
  status.view_count = 2;
  std::uint64_t next = 100;
  for (auto& camera : status.cameras) {
    const auto base = static_cast<double>(next);
    camera.fault = hal::Fault::Stalled;
    camera.frames = next;
    camera.lost = next + 1;
    camera.dropped = next + 2;
    camera.frames_per_second = base + 0.5;
    camera.latency_p50_ms = base + 0.25;
    camera.latency_p99_ms = base + 0.75;
    camera.triggers = next + 3;
    camera.missed = next + 4;
    camera.unmatched = next + 5;
    next += 10;
  }
  for (auto& view : status.views) {
    const auto base = static_cast<double>(next);
    view = {next, next + 1, base + 0.25, base + 0.5, base + 0.75, 0};
    next += 10;
  }
  double value = -7.125;
  for (const auto& signal : signals::kSignals) status.signals.*signal.member = value *= -1.5;
  return status;
}

}  // namespace orbwatch::app::tests
