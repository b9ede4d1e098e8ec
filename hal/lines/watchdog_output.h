#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>

#include "hal/lines/line_back_end.h"
#include "hal/lines/line_task.h"

namespace orbwatch::hal {

struct WatchdogSettings {
  Clock::duration timeout = std::chrono::seconds(1);  ///< without a report the line falls
  Clock::duration half_period{0};  ///< 0: held active; else toggled, each level for so long
};

/// A line that says "all is well", active or toggling only while reports of good health keep
/// coming: process OK (the pipeline works), or an alarm line on the closed-circuit principle (no
/// alarm). It falls when a report is bad, when none comes in time, when the product ends, and,
/// where the board pulls the wire down, when it dies. Only a toggling line also shows that a line
/// hangs. Thread rule: report on any thread, the others on the line thread.
class WatchdogOutput : public LineTask {
 public:
  /// `ring` is called when due() changed on the thread of report().
  WatchdogOutput(const WatchdogSettings& settings, std::unique_ptr<DigitalOutput> output,
                 std::function<void()> ring);

  void report(bool healthy, TimePoint now);

  TimePoint due() const override;
  void run(TimePoint now) override;

  /// Changes that the line refused.
  std::uint64_t failed() const { return failed_; }

 private:
  bool next_level(TimePoint now);

  const WatchdogSettings settings_;
  const std::function<void()> ring_;
  const std::unique_ptr<DigitalOutput> output_;
  mutable std::mutex mutex_;
  bool healthy_ = false;
  TimePoint last_;         ///< report of good health
  bool is_up_ = false;     ///< held or toggling
  TimePoint next_toggle_;  ///< while it is up
  bool active_ = false;    ///< the line's level; of the line thread alone
  std::atomic<std::uint64_t> failed_{0};
};

}  // namespace orbwatch::hal
