#pragma once

#include <array>
#include <chrono>

#include "app/model/status.h"
#include "app/pipeline/second_meter.h"
#include "hal/clock.h"

namespace orbwatch::app {

/// Processor time of each stage per frame set, over all threads that work on it: what a figure in
/// wall time cannot tell while other programs run. Fixed memory; thread-bound: the pipeline's
/// thread.
class StageMeter {
 public:
  /// On the pipeline's thread, before the first frame set.
  void begin();

  /// All that the pipeline's thread has done since the last call belongs to `stage`, and `helped`,
  /// that of others for it.
  void end(Stage stage, std::chrono::nanoseconds helped = {});

  /// Ends a frame set. `capture` and `sinks`: processor time of those threads since their start.
  void end_set(std::chrono::nanoseconds capture, std::chrono::nanoseconds sinks);

  /// Fills in the stages of `status` and busy_ms, as of the newest frame set.
  void report(Status& status) const;
  /// Fills in the percentiles since the last call, which was `elapsed` ago.
  void roll(hal::Clock::duration elapsed, Status& status);

 private:
  /// Time of threads that run by themselves.
  class Growth {
   public:
    /// Since the last call. A thread that has just ended may be missing in `total` once.
    std::chrono::nanoseconds operator()(std::chrono::nanoseconds total);

   private:
    std::chrono::nanoseconds counted_{0};
  };

  std::chrono::nanoseconds counted_{0};                     ///< of the pipeline's thread
  std::chrono::nanoseconds busy_{0};                        ///< of it, in the present set
  std::chrono::nanoseconds newest_busy_{0};                 ///< the same, of the newest set
  std::array<std::chrono::nanoseconds, kStages> spent_{};   ///< by stage, in the present set
  std::array<std::chrono::nanoseconds, kStages> newest_{};  ///< the same, of the newest set
  std::array<SecondMeter, kStages> meters_;                 ///< by stage
  Growth capture_;
  Growth sinks_;
};

}  // namespace orbwatch::app
