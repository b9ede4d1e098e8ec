// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "app/model/sink/recorded_events.h"
#include "app/ports/recorder/events/signal_steps.h"
#include "proc/image/result.h"

namespace orbwatch::app::recorder {

/// Signals of recordings over time. The whole recording is read at first; the signals of the one
/// that was asked for last stay in memory. Thread-safe.
class EventSignals {
 public:
  /// Signals that were a number in any frame set. Errors: those of RecordedStates and SignalSteps;
  /// no frame set.
  Result<std::vector<RecordedSignal>> list(const std::filesystem::path& recording);

  /// Recipes that the recording was measured by. Errors: as list().
  Result<std::vector<RecordedRecipeChange>> recipes(const std::filesystem::path& recording);

  /// Errors also: there is no such signal.
  Result<RecordedCourse> course(const std::filesystem::path& recording, const std::string& region,
                                const std::string& figure);

 private:
  Result<std::shared_ptr<const SignalSteps>> read(const std::filesystem::path& recording);

  std::mutex mutex_;  ///< guards the members below
  std::filesystem::path recording_;
  std::shared_ptr<const SignalSteps> steps_;
};

}  // namespace orbwatch::app::recorder
