// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>

#include "app/model/status/status.h"
#include "app/pipeline/second_meter.h"
#include "hal/clock.h"

namespace orbwatch::app::pipeline {

/// Processor time of each stage per frame set, over all threads that work on it, because wall time
/// is distorted while other programs run. Fixed memory; thread-bound: the pipeline's thread.
class StageMeter {
 public:
  /// Call on the pipeline's thread, before the first frame set.
  void begin();

  /// Assigns the time of the pipeline's thread since the last call to `stage`, and `helped`, the
  /// time of other threads for it.
  void end(Stage stage, std::chrono::nanoseconds helped = {});

  /// Ends a frame set. `capture` and `sinks`: processor time of those threads since their start.
  void end_set(std::chrono::nanoseconds capture, std::chrono::nanoseconds sinks);

  /// Fills in the stages of `status` and busy_ms from the frame set that ended last.
  void report(Status& status) const;
  /// Fills in the percentiles since the last call, which was `elapsed` ago.
  void roll(hal::Clock::duration elapsed, Status& status);

 private:
  /// Increase of the time of threads that run by themselves.
  class Growth {
   public:
    /// Returns the time since the last call. A thread that has just ended may be missing in `total`
    /// once.
    std::chrono::nanoseconds operator()(std::chrono::nanoseconds total);

   private:
    std::chrono::nanoseconds counted_{0};
  };

  std::chrono::nanoseconds counted_{0};      ///< time of the pipeline's thread that was assigned
  std::chrono::nanoseconds busy_{0};         ///< time of the pipeline's thread in the present set
  std::chrono::nanoseconds newest_busy_{0};  ///< the same for the newest set
  std::array<std::chrono::nanoseconds, kStages> spent_{};   ///< time per stage, in the present set
  std::array<std::chrono::nanoseconds, kStages> newest_{};  ///< time per stage, in the newest set
  std::array<SecondMeter, kStages> meters_;                 ///< one per stage
  Growth capture_;
  Growth sinks_;
};

}  // namespace orbwatch::app::pipeline
