#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "hal/lines/line_back_end.h"
#include "hal/lines/line_task.h"

namespace orbwatch::hal {

struct PulseSettings {
  Clock::duration period{0};  ///< 0: pulses on command; else longer than the pulse
  Clock::duration delay{0};   ///< from the command to the pulse
  Clock::duration width = std::chrono::milliseconds(1);
};

struct PulseCounts {
  std::uint64_t pulses = 0;
  std::uint64_t missed = 0;  ///< commands during a pulse; at a rate, pulses that came too late
  std::uint64_t failed = 0;  ///< changes that a line refused
};

/// Pulses on several lines at once: triggers for cameras, at a rate or on command, or a strobe that
/// is fired by the edges of the trigger. A pulse is never shorter than its width; under load it may
/// begin later and be longer. At a rate, pulses stay on the grid of the first: no drift.
/// Thread rule: fire and counts on any thread, the others on the line thread.
class PulseOutput : public LineTask {
 public:
  using Outputs = std::vector<std::unique_ptr<DigitalOutput>>;

  /// `ring` is called when due() changed on the thread of fire(). At a rate the first pulse comes
  /// `delay` after the first run().
  PulseOutput(const PulseSettings& settings, Outputs outputs, std::function<void()> ring);

  /// One pulse, `delay` after `moment`. Returns false, and counts, when one is under way or pulses
  /// come at a rate.
  bool fire(TimePoint moment);

  TimePoint due() const override;
  void run(TimePoint now) override;

  PulseCounts counts() const;

 private:
  void schedule(TimePoint now);
  void begin_pulse(TimePoint now);

  const PulseSettings settings_;
  const std::function<void()> ring_;
  Outputs outputs_;
  mutable std::mutex mutex_;
  bool driven_ = false;  ///< what the lines were set to; of the line thread alone
  bool active_ = false;
  TimePoint rise_;  ///< of the next pulse; max(): none is asked for; min(): at a rate, not begun
  TimePoint fall_ = TimePoint::max();
  PulseCounts counts_;
};

}  // namespace orbwatch::hal
