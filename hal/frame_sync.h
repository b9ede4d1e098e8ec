#pragma once

#include <array>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <optional>

#include "hal/frame.h"

namespace orbwatch::hal {

/// Most cameras that one pipeline joins.
inline constexpr std::size_t kMaxCameras = 4;

/// Frames of several cameras that belong to one moment.
struct FrameSet {
  std::uint64_t id = 0;  ///< counts sets from 1
  TimePoint stamp;       ///< exposure start of the pacing camera's frame
  std::array<Frame, kMaxCameras>
      frames;           ///< by camera; null while one has a fault or before its first
  bool matched = true;  ///< all exposures began within the window
};

/// What FrameSync counted of one camera.
struct FrameCounts {
  std::uint64_t frames = 0;   ///< delivered
  std::uint64_t lost = 0;     ///< gaps in the camera's sequence
  std::uint64_t dropped = 0;  ///< replaced by a newer frame before it was used
};

/// Joins the frames of free-running cameras into sets. Queue per camera: depth 1, newest wins. The
/// first camera without a fault sets the pace; a set is its frame and, of each other camera, the
/// frame whose exposure began within `window` of it, or else the newest older one, held from set to
/// set. Thread rule: put and clear on any thread, next on one, close and counts on any.
class FrameSync {
 public:
  /// `cameras`: 1..kMaxCameras. `window`: largest difference of exposure starts in a matched set,
  /// and the longest time that a pacing frame waits for its partners.
  FrameSync(std::size_t cameras, Clock::duration window);

  /// A frame of `camera`, on the camera's thread. Never waits.
  void put(std::size_t camera, Frame frame);

  /// The camera has a fault: its frames leave, and it neither paces nor is waited for until it
  /// delivers again.
  void clear(std::size_t camera);

  /// The next set; nothing at `until`, or at once after close().
  std::optional<FrameSet> next(TimePoint until);

  /// Ends next() for good.
  void close();

  FrameCounts counts(std::size_t camera) const;

 private:
  struct Inbox {
    Frame pending;         ///< newest, not used yet
    TimePoint arrived;     ///< of pending
    Frame held;            ///< last used
    bool delivers = true;  ///< until a fault says otherwise
    bool started = false;
    std::uint64_t last_sequence = 0;
    FrameCounts counts;
  };

  std::size_t pacing() const;
  bool complete(std::size_t pacer) const;
  bool matches(const Frame& frame, TimePoint moment) const;
  FrameSet assemble(std::size_t pacer, std::array<Frame, kMaxCameras>& released);

  const std::size_t cameras_;
  const Clock::duration window_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::array<Inbox, kMaxCameras> inboxes_;
  std::uint64_t sets_ = 0;
  bool closed_ = false;
};

}  // namespace orbwatch::hal
