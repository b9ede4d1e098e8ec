// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "hal/lines/line.h"
#include "hal/lines/line_retry.h"
#include "hal/lines/line_task.h"

namespace orbwatch::hal {

/// Output line that may be missing. A line that is missing, or fails later, is a fault, is opened
/// again after a BackOff, and then gets the level that was set last. Thread-bound: the line thread.
class WatchedOutput : public DigitalOutput, public LineTask {
 public:
  /// Opens the line of `back_end`, which must outlive it; `on_fault` is called when that fails.
  WatchedOutput(LineBackEnd& back_end, OutputSettings settings, LineRetry::OnFault on_fault,
                TimePoint now);

  /// Error: the line has a fault; it gets the level once it is open again.
  LineResult<> set(bool active) override;

  TimePoint due() const override { return output_ ? check_ : retry_.due(); }
  void run(TimePoint now) override;

 private:
  void open(TimePoint now);

  LineBackEnd& back_end_;
  const OutputSettings settings_;
  LineRetry retry_;
  std::unique_ptr<DigitalOutput> output_;
  bool active_ = false;                 ///< level that was set last
  TimePoint check_ = TimePoint::min();  ///< moment at which the open line is set again, as a probe
};

}  // namespace orbwatch::hal
