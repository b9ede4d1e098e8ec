// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <mutex>
#include <optional>

#include "hal/sync/frame_matcher.h"

namespace orbwatch::hal {

/// Passes frames from the cameras' threads to the pipeline's: a FrameMatcher on the steady clock.
/// Cameras never wait here. Thread rule: put and clear on any thread, next on one, the rest on any.
class FrameSync {
 public:
  FrameSync(std::size_t cameras, const SyncSettings& settings) : matcher_(cameras, settings) {}

  /// Adds a frame of `camera`, on the camera's thread.
  void put(std::size_t camera, Frame frame);

  /// Discards the frames of a camera that has a fault: see FrameMatcher::clear().
  void clear(std::size_t camera);

  /// Waits for the next set; nullopt at `until`, or at once after close().
  std::optional<FrameSet> next(TimePoint until);

  /// True if next() would return a set without waiting: see FrameMatcher::has_set().
  bool has_set() const;

  /// Ends next() for good.
  void close();

  /// See FrameMatcher::is_late().
  bool is_late(std::size_t camera) const;

  FrameCounts counts(std::size_t camera) const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  FrameMatcher matcher_;
  bool closed_ = false;
};

}  // namespace orbwatch::hal
