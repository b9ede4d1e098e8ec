#include "hal/frame_sync.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace orbwatch::hal {

FrameSync::FrameSync(std::size_t cameras, Clock::duration window)
    : cameras_(cameras), window_(window) {
  assert(cameras >= 1 && cameras <= kMaxCameras);
}

void FrameSync::put(std::size_t camera, Frame frame) {
  Frame replaced;  // goes after the lock: its last release may call into a driver
  {
    const std::lock_guard lock(mutex_);
    Inbox& inbox = inboxes_[camera];
    const std::uint64_t sequence = frame->metadata.sequence;
    if (inbox.started && sequence > inbox.last_sequence) {
      inbox.counts.lost += sequence - inbox.last_sequence - 1;
    }
    inbox.started = true;
    inbox.last_sequence = sequence;
    ++inbox.counts.frames;
    inbox.delivers = true;
    inbox.arrived = Clock::now();
    replaced = std::exchange(inbox.pending, std::move(frame));
    inbox.counts.dropped += replaced ? 1 : 0;
  }
  changed_.notify_one();
}

void FrameSync::clear(std::size_t camera) {
  Frame pending, held;
  {
    const std::lock_guard lock(mutex_);
    Inbox& inbox = inboxes_[camera];
    inbox.delivers = false;
    pending = std::exchange(inbox.pending, nullptr);
    held = std::exchange(inbox.held, nullptr);
    inbox.counts.dropped += pending ? 1 : 0;
  }
  changed_.notify_one();
}

std::optional<FrameSet> FrameSync::next(TimePoint until) {
  std::array<Frame, kMaxCameras> released;  // go after the lock
  std::unique_lock lock(mutex_);
  while (!closed_) {
    const std::size_t pacer = pacing();
    TimePoint wake = until;
    if (pacer < cameras_ && inboxes_[pacer].pending) {
      const TimePoint patience = inboxes_[pacer].arrived + window_;
      if (complete(pacer) || Clock::now() >= patience) return assemble(pacer, released);
      wake = std::min(until, patience);
    }
    if (changed_.wait_until(lock, wake) == std::cv_status::timeout && Clock::now() >= until) {
      return std::nullopt;
    }
  }
  return std::nullopt;
}

void FrameSync::close() {
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_all();
}

FrameCounts FrameSync::counts(std::size_t camera) const {
  const std::lock_guard lock(mutex_);
  return inboxes_[camera].counts;
}

std::size_t FrameSync::pacing() const {
  for (std::size_t i = 0; i < cameras_; ++i) {
    if (inboxes_[i].delivers) return i;
  }
  return cameras_;
}

bool FrameSync::matches(const Frame& frame, TimePoint moment) const {
  return frame && std::chrono::abs(frame->metadata.exposure_start - moment) <= window_;
}

bool FrameSync::complete(std::size_t pacer) const {
  const TimePoint moment = inboxes_[pacer].pending->metadata.exposure_start;
  for (std::size_t i = 0; i < cameras_; ++i) {
    const Inbox& inbox = inboxes_[i];
    if (i != pacer && inbox.delivers && !matches(inbox.pending, moment) &&
        !matches(inbox.held, moment)) {
      return false;
    }
  }
  return true;
}

FrameSet FrameSync::assemble(std::size_t pacer, std::array<Frame, kMaxCameras>& released) {
  FrameSet set;
  set.id = ++sets_;
  set.stamp = inboxes_[pacer].pending->metadata.exposure_start;
  for (std::size_t i = 0; i < cameras_; ++i) {
    Inbox& inbox = inboxes_[i];
    // A partner from after the window belongs to a later set.
    const bool due = inbox.pending && inbox.pending->metadata.exposure_start <= set.stamp + window_;
    if (i == pacer || due || !inbox.held) {
      if (inbox.pending) {
        released[i] = std::exchange(inbox.held, std::exchange(inbox.pending, nullptr));
      }
    }
    set.frames[i] = inbox.held;
    set.matched &= !inbox.held || matches(inbox.held, set.stamp);
  }
  return set;
}

}  // namespace orbwatch::hal
