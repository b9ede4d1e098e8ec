// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/ports/recorder/recorded_states.h"
#include "hal/frame/frame_pool.h"
#include "hal/recording/camera_recording.h"
#include "hal/recording/recorded_clock.h"
#include "hal/sync/frame_matcher.h"
#include "proc/image/result.h"

namespace orbwatch::app::daemon {

/// A frame set of a recording, as the pipeline had it, and what was reported of it.
struct RecordedSet {
  std::uint64_t utc = 0;    ///< its stamp, ns since 1970
  hal::TimePoint computed;  ///< when it was measured
  recorder::ProcessState state;
  hal::FrameSet frames;
};

/// The frame sets of a recording in their order. Thread-bound.
class RecordedSets {
 public:
  /// `cameras`: names, in the site's order; `policies`: what a set has of a camera without a
  /// picture. Errors: those of CameraRecording::open(); no states of the process.
  static Result<RecordedSets> open(const std::filesystem::path& file,
                                   const std::vector<std::string>& cameras,
                                   const std::vector<hal::SyncPolicy>& policies);

  /// Formats by camera; those without pictures in the recording have no size.
  std::vector<hal::StreamFormat> formats() const;

  /// Quality of JPEG by camera, where the recorder coded it; nullopt: the camera's own data, or
  /// lossless.
  std::vector<std::optional<int>> jpeg_qualities() const;

  /// The next set; nullopt behind the last one. Its frames must be released before the next call.
  /// Sets without a picture are counted and left out. Errors: damaged; states that go backwards.
  Result<std::optional<RecordedSet>> next();

  /// States without a picture so far.
  std::size_t without_pictures() const { return without_pictures_; }
  /// States so far.
  std::size_t states() const { return states_.count(); }
  /// States of the whole recording as its summary states them; 0: it does not.
  std::size_t stated() const { return stated_; }
  /// Stamp of the last message, ns since 1970.
  std::uint64_t end() const { return end_; }

 private:
  struct Camera {
    std::optional<hal::recording::CameraRecording> pictures;  ///< none: not recorded
    hal::SyncPolicy policy{};
    std::optional<hal::FramePool> pool;
    std::size_t next = 0;  ///< exposure
    hal::Frame newest;
  };

  RecordedSets(recorder::RecordedStates states, hal::recording::RecordedClock clock);

  Result<std::optional<RecordedSet>> next_state();
  Result<bool> add_frames(RecordedSet& set);
  Result<bool> add_frame(std::size_t camera, RecordedSet& set);

  recorder::RecordedStates states_;
  hal::recording::RecordedClock clock_;
  std::vector<Camera> cameras_;
  std::uint64_t newest_ = 0;  ///< stamp
  std::size_t without_pictures_ = 0;
  std::size_t stated_ = 0;
  std::uint64_t end_ = 0;
};

}  // namespace orbwatch::app::daemon
