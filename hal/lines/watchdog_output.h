// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>

#include "hal/lines/line.h"
#include "hal/lines/line_task.h"
#include "hal/thread/priority_mutex.h"

namespace orbwatch::hal {

struct WatchdogSettings {
  Clock::duration timeout =
      std::chrono::seconds(1);     ///< longest time without a report before the line goes inactive
  Clock::duration half_period{0};  ///< half period of the toggling; 0: held active
};

/// Line that is active or toggles only while healthy reports arrive: process OK (the pipeline
/// works), or an alarm line on the closed-circuit principle (no alarm). It goes inactive on an
/// unhealthy report, without a report in time, when the program ends, and, if the board pulls the
/// wire down, when it crashes. Only toggling also reveals a stuck line. Thread rule: report on any
/// thread, the others on the line thread.
class WatchdogOutput : public LineTask {
 public:
  /// `wake` is called when report() has changed due().
  WatchdogOutput(const WatchdogSettings& settings, std::unique_ptr<DigitalOutput> output,
                 std::function<void()> wake);

  void report(bool healthy, TimePoint now);

  TimePoint due() const override;
  void run(TimePoint now) override;

  /// Number of levels that the line refused.
  std::uint64_t failed() const { return failed_; }

 private:
  bool next_level(TimePoint now);

  const WatchdogSettings settings_;
  const std::function<void()> wake_;
  const std::unique_ptr<DigitalOutput> output_;
  mutable PriorityMutex mutex_;
  bool healthy_ = false;
  TimePoint last_;         ///< moment of the last healthy report
  bool is_up_ = false;     ///< the line is held active or toggles
  TimePoint next_toggle_;  ///< valid while is_up_
  bool active_ = false;    ///< level of the line; used by the line thread only
  std::atomic<std::uint64_t> failed_{0};
};

}  // namespace orbwatch::hal
