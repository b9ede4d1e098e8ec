// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "hal/frame/buffer_count.h"
#include "hal/sync/frame_set.h"

namespace orbwatch::hal {

/// Content of a set for a camera that has no frame of the set's moment.
enum class SyncPolicy : std::uint8_t {
  Hold,     ///< the camera's newest older frame, from set to set, until it is late
  Nearest,  ///< no frame; each frame is in one set at most
};

/// Settings for joining frames.
struct SyncSettings {
  /// Largest difference of exposure starts within one moment. Below half a period of the fastest
  /// camera no frame has two partners to choose from.
  Clock::duration window = std::chrono::milliseconds(10);
  /// Longest time that a frame of the pacing camera waits for its partners after it arrived.
  Clock::duration max_wait = std::chrono::milliseconds(10);
  std::array<SyncPolicy, kMaxCameras> policies{};  ///< policy of each camera
};

/// Counts one camera's frames by their fate. A frame in none of the sums still waits.
struct FrameCounts {
  std::uint64_t frames = 0;  ///< delivered frames
  std::uint64_t lost = 0;    ///< frames that were never delivered: gaps in the camera's sequence
  std::uint64_t used = 0;    ///< frames in a set; counted once, also when held
  std::uint64_t superseded =
      0;  ///< frames of the pacing camera that a newer ready one replaced before use
  std::uint64_t overflowed = 0;  ///< triggered frames lost because the queue was full of newer ones
  std::uint64_t unmatched =
      0;  ///< frames without a set of their moment: the pacing camera had no frame then
  std::uint64_t cleared = 0;  ///< frames that waited when their camera had a fault

  /// Frames that should have reached the pipeline but did not.
  std::uint64_t dropped() const { return superseded + overflowed + cleared; }
};

/// Frames that left the queues. The caller clears it without holding a lock: the last release of a
/// frame calls into its camera.
class ReleasedFrames {
 public:
  void add(Frame frame) {
    if (frame) frames_[count_++] = std::move(frame);
  }
  bool is_empty() const { return count_ == 0; }
  void clear() {
    while (count_ > 0) frames_[--count_].reset();
  }

 private:
  static constexpr std::size_t kMost = kMaxCameras * (kTriggeredDepth + kHeldFrames);
  std::array<Frame, kMost> frames_;
  std::size_t count_ = 0;
};

/// Decides which frames form a set; uses neither clock nor threads. Thread-bound.
///
/// The first camera without a fault that is not late sets the pace: each set consists of one of its
/// frames and, from every other camera, the unused frame of the same moment. That is the one with
/// the same trigger number when both have one, else the nearest whose exposure began within the
/// window. A frame of the pacing camera waits until no nearer partner can come, judged by the
/// partner's own interval, or for at most SyncSettings::max_wait. A free-running camera is late
/// after three of its intervals without a frame, and 100 ms at least: a silent one must neither
/// stop the sets of the others until it is known to have a fault, nor be shown as new. Queues: for
/// a free-running camera the last kFreeRunningDepth frames (1 when it is alone); for the pacing
/// camera the newest ready frame wins; for a triggered camera a FIFO of kTriggeredDepth, each of
/// which becomes a set. Without triggers, frames from before the last set make none after a change
/// of the pacing camera: stamps do not go backwards. Frames that leave unused are counted by
/// reason.
class FrameMatcher {
 public:
  /// `cameras`: 1..kMaxCameras. Window and max_wait must not be below 0.
  FrameMatcher(std::size_t cameras, const SyncSettings& settings);

  /// Adds a frame of `camera` that arrived at `now`.
  void put(std::size_t camera, Frame frame, TimePoint now, ReleasedFrames& released);

  /// Discards the frames of a camera that has a fault. Until it delivers again, it does not pace
  /// and no set waits for it.
  void clear(std::size_t camera, ReleasedFrames& released);

  /// Takes the set that is ready at `now`, or nullopt.
  std::optional<FrameSet> take(TimePoint now, ReleasedFrames& released);

  /// True if a set is ready at `now`. A repeated trigger, which take() discards, counts as one.
  bool has_set(TimePoint now) const;

  /// True if the camera, which has no fault, is late at `now`.
  bool is_late(std::size_t camera, TimePoint now) const { return now > due(inboxes_[camera]); }

  /// Earliest moment, seen at `now`, at which take() may return a set without another put();
  /// TimePoint::max(): never.
  TimePoint wake(TimePoint now) const;

  const FrameCounts& counts(std::size_t camera) const { return inboxes_[camera].counts; }

 private:
  using Reason = std::uint64_t FrameCounts::*;

  struct Waiting {
    Frame frame;
    TimePoint arrived;
  };
  struct Inbox {
    std::array<Waiting, kTriggeredDepth> queue;  ///< in the order of arrival
    std::size_t size = 0;
    Frame held;                         ///< frame that was used last
    bool delivers = true;               ///< it had no fault since its last frame
    std::optional<FrameMetadata> last;  ///< metadata of the newest frame
    TimePoint arrived;                  ///< arrival of the newest frame
    Clock::duration interval{0};        ///< time between exposures; 0: unknown
    FrameCounts counts;

    Frame pop(std::size_t index);
  };

  static void observe(Inbox& inbox, const FrameMetadata& metadata, TimePoint now);
  static TimePoint due(const Inbox& inbox);
  static void discard(Inbox& inbox, std::size_t index, Reason reason, ReleasedFrames& released);
  std::size_t depth(const Frame& frame) const;
  std::size_t pacing(TimePoint now) const;
  bool is_past(const FrameMetadata& frame) const;
  void discard_late(Inbox& pacer, ReleasedFrames& released);
  std::optional<std::size_t> choose(std::size_t pacer, TimePoint now) const;
  bool is_ready(std::size_t pacer, std::size_t index, TimePoint now) const;
  bool is_settled(const Inbox& partner, const FrameMetadata& paced) const;
  bool is_of_moment(const FrameMetadata& frame, const FrameMetadata& paced) const;
  std::optional<std::size_t> nearest(const Inbox& partner, const FrameMetadata& paced) const;
  bool join(std::size_t partner, const FrameMetadata& paced, TimePoint now, FrameSet& set,
            ReleasedFrames& released);
  FrameSet assemble(std::size_t pacer, TimePoint now, ReleasedFrames& released);

  const std::size_t cameras_;
  const SyncSettings settings_;
  std::array<Inbox, kMaxCameras> inboxes_;
  std::uint64_t sets_ = 0;
  std::optional<std::uint64_t> last_trigger_;  ///< trigger of the newest triggered set
  std::optional<TimePoint> last_stamp_;        ///< stamp of the last set
};

}  // namespace orbwatch::hal
