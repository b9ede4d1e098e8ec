#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "hal/frame_set.h"

namespace orbwatch::hal {

/// What a set has of a camera without a frame of the set's moment.
enum class SyncPolicy : std::uint8_t {
  Hold,     ///< its newest older frame, from set to set, however old
  Nearest,  ///< nothing; each frame is in one set at most
};

/// How frames are joined.
struct SyncSettings {
  /// Largest difference of exposure starts within one moment. Below half a period of the fastest
  /// camera no frame has two partners to choose from.
  Clock::duration window = std::chrono::milliseconds(10);
  /// Longest time that a frame of the pacing camera waits for its partners after it arrived.
  Clock::duration patience = std::chrono::milliseconds(10);
  std::array<SyncPolicy, kMaxCameras> policies{};  ///< by camera
};

/// What became of one camera's frames. A frame that is in none of the sums still waits.
struct FrameCounts {
  std::uint64_t frames = 0;      ///< delivered
  std::uint64_t lost = 0;        ///< never delivered: gaps in the camera's sequence
  std::uint64_t used = 0;        ///< in a set; once, however long it was held
  std::uint64_t superseded = 0;  ///< of the pacing camera: a newer one was ready before it was used
  std::uint64_t overflowed = 0;  ///< triggered: the queue was full of newer ones
  std::uint64_t unmatched = 0;   ///< no set of its moment: the pacing camera had no frame then
  std::uint64_t cleared = 0;     ///< waited when its camera had a fault

  /// Frames that the pipeline should have seen but did not.
  std::uint64_t dropped() const { return superseded + overflowed + cleared; }
};

/// Frames on their way out. Whoever holds the bin empties it where it holds no lock: the last
/// release of a frame calls into its camera.
class FrameBin {
 public:
  void add(Frame frame) {
    if (frame) frames_[count_++] = std::move(frame);
  }
  bool is_empty() const { return count_ == 0; }
  void clear() {
    while (count_ > 0) frames_[--count_].reset();
  }

 private:
  static constexpr std::size_t kMost = kMaxCameras * 9;  ///< full queues and held frames
  std::array<Frame, kMost> frames_;
  std::size_t count_ = 0;
};

/// Decides which frames form a set; knows neither clock nor threads. Thread-bound.
///
/// The first camera without a fault sets the pace: each set is a frame of it and, of every other
/// camera, the unused frame of the same moment. That is the one with the same trigger number when
/// both have one, else the nearest whose exposure began within the window. A frame of the pacing
/// camera waits until no nearer partner can come, judged by the partner's own interval, or until
/// its patience is over.
/// Queues: of a free-running camera the last 3 frames, for the nearest to be among them (1 when it
/// is alone), and of the pacing one the newest that is ready wins; of a triggered camera a FIFO of
/// 8, each of which becomes a set. What leaves unused is counted with its reason.
class FrameMatcher {
 public:
  /// `cameras`: 1..kMaxCameras. Window and patience must not be below 0.
  FrameMatcher(std::size_t cameras, const SyncSettings& settings);

  /// A frame of `camera`, which arrived at `now`.
  void put(std::size_t camera, Frame frame, TimePoint now, FrameBin& bin);

  /// The camera has a fault: its frames leave, and it neither paces nor is waited for until it
  /// delivers again.
  void clear(std::size_t camera, FrameBin& bin);

  /// The set that is ready at `now`, if one is.
  std::optional<FrameSet> take(TimePoint now, FrameBin& bin);

  /// When take() may have a set although nothing was put since; TimePoint::max(): never.
  TimePoint wake() const;

  const FrameCounts& counts(std::size_t camera) const { return inboxes_[camera].counts; }

 private:
  static constexpr std::size_t kFreeRunningDepth = 3;
  static constexpr std::size_t kTriggeredDepth = 8;
  using Reason = std::uint64_t FrameCounts::*;

  struct Waiting {
    Frame frame;
    TimePoint arrived;
  };
  struct Inbox {
    std::array<Waiting, kTriggeredDepth> queue;  ///< in the order of arrival
    std::size_t size = 0;
    Frame held;                         ///< last used
    bool delivers = true;               ///< until a fault says otherwise
    std::optional<FrameMetadata> last;  ///< of the frame that arrived last
    Clock::duration interval{0};        ///< from exposure to exposure; 0: not known
    FrameCounts counts;

    Frame pop(std::size_t index);
  };

  static void note(Inbox& inbox, const FrameMetadata& metadata);
  static void discard(Inbox& inbox, std::size_t index, Reason reason, FrameBin& bin);
  std::size_t depth(const Frame& frame) const;
  std::size_t pacing() const;
  void discard_late(Inbox& pacer, FrameBin& bin);
  std::optional<std::size_t> choose(std::size_t pacer, TimePoint now) const;
  bool is_ready(std::size_t pacer, std::size_t index, TimePoint now) const;
  bool is_settled(const Inbox& partner, const FrameMetadata& paced) const;
  bool is_of_moment(const FrameMetadata& frame, const FrameMetadata& paced) const;
  std::optional<std::size_t> nearest(const Inbox& partner, const FrameMetadata& paced) const;
  bool join(std::size_t partner, const FrameMetadata& paced, FrameSet& set, FrameBin& bin);
  FrameSet assemble(std::size_t pacer, FrameBin& bin);

  const std::size_t cameras_;
  const SyncSettings settings_;
  std::array<Inbox, kMaxCameras> inboxes_;
  std::uint64_t sets_ = 0;
  std::optional<std::uint64_t> last_trigger_;  ///< of the newest triggered set
};

}  // namespace orbwatch::hal
