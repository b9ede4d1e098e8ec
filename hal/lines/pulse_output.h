// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "hal/lines/line.h"
#include "hal/lines/line_task.h"
#include "hal/thread/priority_mutex.h"

namespace orbwatch::hal {

struct PulseSettings {
  Clock::duration period{0};  ///< 0: pulses on request; otherwise longer than the pulse
  Clock::duration delay{0};   ///< time from the request to the pulse
  Clock::duration width = std::chrono::milliseconds(1);
};

struct PulseCounts {
  std::uint64_t pulses = 0;
  std::uint64_t missed = 0;  ///< requests during a pulse; skipped periods
  std::uint64_t failed = 0;  ///< pulses that a line refused
};

/// Pulses on several lines at once: camera triggers, periodic or on request, or a strobe on the
/// trigger's edges. A pulse is never shorter than its width; under load it may be late or longer.
/// Periodic pulses do not drift: they keep the grid of the first.
/// Thread rule: fire and counts on any thread, the others on the line thread.
class PulseOutput : public LineTask {
 public:
  using Outputs = std::vector<std::unique_ptr<DigitalOutput>>;

  /// `wake` is called when fire() has changed due(). The first periodic pulse is `delay` after the
  /// first run().
  PulseOutput(const PulseSettings& settings, Outputs outputs, std::function<void()> wake);

  /// Requests one pulse, `delay` after `moment`. Returns false, and counts it as missed, during a
  /// pulse or with periodic pulses.
  bool fire(TimePoint moment);

  TimePoint due() const override;
  void run(TimePoint now) override;

  PulseCounts counts() const;

 private:
  void schedule(TimePoint now);
  void begin_pulse(TimePoint now);

  const PulseSettings settings_;
  const std::function<void()> wake_;
  Outputs outputs_;
  mutable PriorityMutex mutex_;
  bool driven_ = false;  ///< level of the lines; used by the line thread only
  bool active_ = false;
  TimePoint rise_;  ///< moment of the next pulse; max(): none; min(): periodic, not begun
  TimePoint fall_ = TimePoint::max();
  PulseCounts counts_;
};

}  // namespace orbwatch::hal
