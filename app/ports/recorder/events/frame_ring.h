// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "hal/clock.h"
#include "hal/recording/picture_region.h"
#include "hal/thread/priority_mutex.h"
#include "proc/image/picture.h"

namespace orbwatch::app::recorder {

/// A camera's picture in the ring.
struct KeptFrame {
  std::size_t camera = 0;
  std::uint64_t frame_set = 0;
  std::uint64_t sequence = 0;          ///< of the camera, see hal::FrameMetadata
  hal::TimePoint set_stamp;            ///< of the frame set
  hal::TimePoint stamp;                ///< start of its own exposure
  hal::recording::PicturePlace place;  ///< of the picture in the camera's whole one
  Picture picture;                     ///< the part that is kept
  /// The picture as the camera sent it; then the ring keeps no pixels, and `picture` has none.
  std::span<const std::byte> jpeg = {};
  double kelvin_per_count = 0;  ///< scale of a radiometric camera; 0: it is none
  double kelvin_offset = 0;
};

/// Figures of the ring.
struct RingUse {
  std::size_t bytes = 0;         ///< of pictures in it
  hal::Clock::duration span{0};  ///< from the oldest picture to the newest
  std::uint64_t lost = 0;        ///< pictures that found no room, since start
};

/// Pictures that wait, in a fixed number of bytes: a new one replaces the oldest ones, except those
/// that a window holds and that were not read from it yet; if there is no other room, the new one
/// is lost and counted. Allocates nothing after its construction; the lock is held only while
/// places are assigned, never while pixels are copied.
/// Thread rule: put, hold, extend and close on the pipeline's thread; next, pass, last_of,
/// lost_of, is_over and release on one other; use on any.
class FrameRing {
 public:
  /// Most windows at once.
  static constexpr std::size_t kMostWindows = 8;

  /// `least_frame`: bytes of the smallest picture, which bounds their number.
  FrameRing(std::size_t bytes, std::size_t least_frame);

  /// Copies the picture, or its JPEG data. False: it is lost.
  bool put(const KeptFrame& frame);

  /// A window that holds the pictures of all frame sets from `first` to `last`, both included, also
  /// those to come, until it is released.
  struct Window {
    std::size_t number = 0;
    bool is_whole = true;  ///< false: pictures of that time were replaced or lost before
  };
  /// Nullopt: there are too many.
  std::optional<Window> hold(hal::TimePoint first, hal::TimePoint last);
  /// Moves the end of a window that is not closed. False: it was released.
  bool extend(std::size_t window, hal::TimePoint last);
  /// Ends a window: no picture of its time is going to come. It is free once it was released, too.
  void close(std::size_t window);

  /// The next picture of the window, valid until pass(); nullopt: none at present.
  std::optional<KeptFrame> next(std::size_t window) const;
  /// Gives up the picture that next() returned.
  void pass(std::size_t window);
  /// Present end of the window.
  hal::TimePoint last_of(std::size_t window) const;
  /// Pictures of the window's time that found no room since hold().
  std::uint64_t lost_of(std::size_t window) const;
  /// True: the window is closed and all of its pictures were read.
  bool is_over(std::size_t window) const;
  /// Nothing is read from the window any more.
  void release(std::size_t window);

  RingUse use() const;

 private:
  struct Slot {
    KeptFrame frame;
    std::uint64_t begin = 0;  ///< in bytes since start, see place_for()
    std::uint64_t end = 0;
  };
  struct Held {
    bool is_read = false;   ///< from hold() to release()
    bool is_closed = true;  ///< otherwise from hold() to close()
    hal::TimePoint first, last;
    std::uint64_t next = 0;  ///< number of the slot that is read next
    std::uint64_t lost = 0;  ///< see lost_of()

    /// True: it is read, and its time includes the frame set.
    bool needs(hal::TimePoint stamp) const { return is_read && stamp >= first && stamp <= last; }
  };

  const Slot* next_of(const Held& window) const;
  Slot& slot(std::uint64_t number) { return slots_[number % slots_.size()]; }
  const Slot& slot(std::uint64_t number) const { return slots_[number % slots_.size()]; }
  bool is_held(std::uint64_t number) const;
  std::optional<std::uint64_t> place_for(std::size_t bytes);
  void lose(hal::TimePoint stamp);

  std::vector<std::byte> bytes_;
  std::vector<Slot> slots_;
  mutable hal::PriorityMutex mutex_;
  // Guarded by mutex_; slots from oldest_ to behind_ are in use.
  std::uint64_t oldest_ = 0, behind_ = 0;
  std::array<Held, kMostWindows> windows_;
  hal::TimePoint missing_{hal::TimePoint::min()};  ///< frame set of the newest replaced or lost one
  std::uint64_t lost_ = 0;
};

}  // namespace orbwatch::app::recorder
