// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "app/files/resolve.h"
#include "app/model/machine/machine_status.h"
#include "hal/clock.h"
#include "hal/sync/frame_set.h"
#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// The recording that the site's cameras replay. Errors: none does; several recordings. Reentrant.
Result<std::filesystem::path> replayed_recording(const files::Resolved& site);

/// The machine's states of a recording that cameras replay. A frame set has the state that was
/// reported with the recorded one, found by its original stamp, so that pauses and repetitions of
/// the replay do not matter. Thread rule: load() on one thread, the rest on the pipeline's.
class RecordedMachine {
 public:
  /// States of an hour at 60 frame sets a second fit.
  static constexpr std::size_t kMostStates = std::size_t{1} << 18;

  /// `timeout`: time without a frame set after which nothing is known.
  RecordedMachine(std::filesystem::path recording, hal::Clock::duration timeout);

  /// Reads the states; until then nothing is known. Errors, with the file: it cannot be read, has
  /// no states of a machine or too many, or one with a value that a machine cannot have.
  Result<> load();

  /// At the exposure of a frame set; valid until the next call. A set without a new replayed frame
  /// has the state of the one before.
  const MachineStatus& follow(const hal::FrameSet& set);
  /// Between frame sets.
  const MachineStatus& keep(hal::TimePoint now);

 private:
  struct State {
    std::uint64_t set_time = 0;  ///< stamp of the frame set, ns of UTC
    MachineStatus machine;       ///< its moments are those of a set at the epoch
  };

  const State* find(std::uint64_t set_time) const;

  const std::filesystem::path recording_;
  const hal::Clock::duration timeout_;
  std::vector<State> states_;  ///< ascending; written before is_loaded_ is set
  std::atomic<bool> is_loaded_{false};
  hal::TimePoint newest_{};  ///< stamp of the newest frame set
  MachineStatus status_;
};

}  // namespace orbwatch::app::daemon
