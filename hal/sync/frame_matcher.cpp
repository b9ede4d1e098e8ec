// SPDX-License-Identifier: Apache-2.0
#include "hal/sync/frame_matcher.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace orbwatch::hal {
namespace {

/// Intervals without a frame after which a free-running camera is late.
constexpr int kLateIntervals = 3;
constexpr Clock::duration kLeastPatience = std::chrono::milliseconds(100);
/// A stamp so far back is that of a clock that was set, and no late frame.
constexpr Clock::duration kClockStep = std::chrono::seconds(10);

bool have_triggers(const FrameMetadata& a, const FrameMetadata& b) {
  return a.trigger.has_value() && b.trigger.has_value();
}

bool is_before(const FrameMetadata& frame, const FrameMetadata& paced) {
  if (have_triggers(frame, paced)) return *frame.trigger < *paced.trigger;
  return frame.exposure_start < paced.exposure_start;
}

}  // namespace

FrameMatcher::FrameMatcher(std::size_t cameras, const SyncSettings& settings)
    : cameras_(cameras), settings_(settings) {
  assert(cameras >= 1 && cameras <= kMaxCameras);
  assert(settings.window.count() >= 0 && settings.max_wait.count() >= 0);
}

Frame FrameMatcher::Inbox::pop(std::size_t index) {
  Frame frame = std::move(queue[index].frame);
  const auto first = queue.begin() + static_cast<std::ptrdiff_t>(index);
  std::move(first + 1, queue.begin() + static_cast<std::ptrdiff_t>(size), first);
  --size;
  return frame;
}

void FrameMatcher::discard(Inbox& inbox, std::size_t index, Reason reason,
                           ReleasedFrames& released) {
  released.add(inbox.pop(index));
  ++(inbox.counts.*reason);
}

void FrameMatcher::put(std::size_t camera, Frame frame, TimePoint now, ReleasedFrames& released) {
  Inbox& inbox = inboxes_[camera];
  observe(inbox, frame->metadata, now);
  const bool paces = camera == pacing(now);
  const std::size_t limit = depth(frame);
  while (inbox.size >= limit) {
    const bool triggered = inbox.queue[0].frame->metadata.trigger.has_value();
    discard(inbox, 0,
            triggered ? &FrameCounts::overflowed
            : paces   ? &FrameCounts::superseded
                      : &FrameCounts::unmatched,
            released);
  }
  inbox.queue[inbox.size++] = {std::move(frame), now};
}

void FrameMatcher::observe(Inbox& inbox, const FrameMetadata& metadata, TimePoint now) {
  ++inbox.counts.frames;
  const bool continues = std::exchange(inbox.delivers, true);
  inbox.interval = Clock::duration::zero();
  if (inbox.last && metadata.sequence > inbox.last->sequence) {
    const std::uint64_t steps = metadata.sequence - inbox.last->sequence;
    const Clock::duration elapsed = metadata.exposure_start - inbox.last->exposure_start;
    inbox.counts.lost += steps - 1;
    // The first interval after a fault is the length of the outage.
    if (continues && elapsed.count() > 0) {
      inbox.interval = Clock::duration(
          static_cast<Clock::rep>(static_cast<std::uint64_t>(elapsed.count()) / steps));
    }
  }
  inbox.last = metadata;
  inbox.arrived = now;
}

/// The latest arrival of the next frame; a triggered camera, or one of unknown interval, has none.
TimePoint FrameMatcher::due(const Inbox& inbox) {
  const bool is_paced = inbox.delivers && inbox.last && !inbox.last->trigger;
  if (!is_paced || inbox.interval.count() == 0) return TimePoint::max();
  return inbox.arrived + std::max(kLateIntervals * inbox.interval, kLeastPatience);
}

void FrameMatcher::clear(std::size_t camera, ReleasedFrames& released) {
  Inbox& inbox = inboxes_[camera];
  inbox.delivers = false;
  inbox.interval = Clock::duration::zero();
  while (inbox.size > 0) discard(inbox, 0, &FrameCounts::cleared, released);
  released.add(std::exchange(inbox.held, nullptr));
}

std::size_t FrameMatcher::depth(const Frame& frame) const {
  if (frame->metadata.trigger) return kTriggeredDepth;
  return cameras_ == 1 ? 1 : kFreeRunningDepth;
}

/// The first camera that delivers; a late one only if all are late.
std::size_t FrameMatcher::pacing(TimePoint now) const {
  std::size_t first = cameras_;
  for (std::size_t camera = 0; camera < cameras_; ++camera) {
    if (!inboxes_[camera].delivers) continue;
    if (!is_late(camera, now)) return camera;
    first = std::min(first, camera);
  }
  return first;
}

std::optional<FrameSet> FrameMatcher::take(TimePoint now, ReleasedFrames& released) {
  const std::size_t pacer = pacing(now);
  if (pacer == cameras_) return std::nullopt;
  Inbox& inbox = inboxes_[pacer];
  discard_late(inbox, released);
  const auto chosen = choose(pacer, now);
  if (!chosen) return std::nullopt;
  for (std::size_t i = 0; i < *chosen; ++i) discard(inbox, 0, &FrameCounts::superseded, released);
  return assemble(pacer, now, released);
}

bool FrameMatcher::has_set(TimePoint now) const {
  const std::size_t pacer = pacing(now);
  return pacer != cameras_ && choose(pacer, now);
}

/// True if a set was made of the frame's trigger or of a later moment, by another pacing camera.
bool FrameMatcher::is_past(const FrameMetadata& frame) const {
  if (frame.trigger) return last_trigger_ && *frame.trigger <= *last_trigger_;
  if (!last_stamp_) return false;
  const Clock::duration late = *last_stamp_ - frame.exposure_start;
  return late > Clock::duration::zero() && late < kClockStep;
}

void FrameMatcher::discard_late(Inbox& pacer, ReleasedFrames& released) {
  while (pacer.size > 0 && is_past(pacer.queue[0].frame->metadata)) {
    discard(pacer, 0, &FrameCounts::unmatched, released);
  }
}

TimePoint FrameMatcher::wake(TimePoint now) const {
  const std::size_t pacer = pacing(now);
  if (pacer == cameras_) return TimePoint::max();
  const Inbox& inbox = inboxes_[pacer];
  if (inbox.size > 0) return inbox.queue[0].arrived + settings_.max_wait;
  if (is_late(pacer, now) || due(inbox) == TimePoint::max()) return TimePoint::max();
  return due(inbox) + Clock::duration(1);  // then another one paces
}

/// The pacing camera's frame of the next set: the oldest triggered one, else the newest ready one.
std::optional<std::size_t> FrameMatcher::choose(std::size_t pacer, TimePoint now) const {
  const Inbox& inbox = inboxes_[pacer];
  std::size_t candidates = 0;
  while (candidates < inbox.size && !inbox.queue[candidates].frame->metadata.trigger) ++candidates;
  if (candidates == 0 && inbox.size > 0) candidates = 1;
  while (candidates > 0) {
    if (is_ready(pacer, --candidates, now)) return candidates;
  }
  return std::nullopt;
}

bool FrameMatcher::is_ready(std::size_t pacer, std::size_t index, TimePoint now) const {
  const Inbox& inbox = inboxes_[pacer];
  const Waiting& waiting = inbox.queue[index];
  // The next frame would push this one out of the queue.
  const bool is_pressed = index == 0 && inbox.size >= depth(waiting.frame);
  if (is_pressed || now >= waiting.arrived + settings_.max_wait) return true;
  for (std::size_t i = 0; i < cameras_; ++i) {
    if (i != pacer && !is_settled(inboxes_[i], waiting.frame->metadata)) return false;
  }
  return true;
}

/// True when this camera can no longer deliver a better partner for `paced`.
bool FrameMatcher::is_settled(const Inbox& partner, const FrameMetadata& paced) const {
  if (!partner.delivers) return true;
  if (!partner.last) return false;
  if (have_triggers(*partner.last, paced)) return *partner.last->trigger >= *paced.trigger;
  const TimePoint newest = partner.last->exposure_start;
  if (newest >= paced.exposure_start) return true;
  if (partner.interval.count() == 0) return false;
  const auto best = nearest(partner, paced);
  const Clock::duration reach =
      best ? std::chrono::abs(partner.queue[*best].frame->metadata.exposure_start -
                              paced.exposure_start)
           : settings_.window;
  // A quarter of the interval is allowed for jitter.
  return newest + partner.interval * 3 / 4 > paced.exposure_start + reach;
}

bool FrameMatcher::is_of_moment(const FrameMetadata& frame, const FrameMetadata& paced) const {
  if (have_triggers(frame, paced)) return *frame.trigger == *paced.trigger;
  return std::chrono::abs(frame.exposure_start - paced.exposure_start) <= settings_.window;
}

std::optional<std::size_t> FrameMatcher::nearest(const Inbox& partner,
                                                 const FrameMetadata& paced) const {
  std::optional<std::size_t> best;
  const auto distance = [&](std::size_t i) {
    return std::chrono::abs(partner.queue[i].frame->metadata.exposure_start - paced.exposure_start);
  };
  for (std::size_t i = 0; i < partner.size; ++i) {
    if (!is_of_moment(partner.queue[i].frame->metadata, paced)) continue;
    if (!best || distance(i) < distance(*best)) best = i;
  }
  return best;
}

/// Puts one camera's frame into the set; true when it belongs to the set's moment.
bool FrameMatcher::join(std::size_t partner, const FrameMetadata& paced, TimePoint now,
                        FrameSet& set, ReleasedFrames& released) {
  Inbox& inbox = inboxes_[partner];
  const bool holds = settings_.policies[partner] == SyncPolicy::Hold && !is_late(partner, now);
  auto chosen = nearest(inbox, paced);
  for (std::size_t i = 0; holds && !chosen && i < inbox.size; ++i) {
    const std::size_t newest_first = inbox.size - 1 - i;
    if (is_before(inbox.queue[newest_first].frame->metadata, paced)) chosen = newest_first;
  }
  const bool fresh = chosen.has_value();
  Frame frame = fresh ? inbox.pop(*chosen) : (holds ? inbox.held : nullptr);
  // Frames older than this set belong to no later one.
  for (std::size_t i = 0; i < inbox.size;) {
    if (is_before(inbox.queue[i].frame->metadata, paced)) {
      discard(inbox, i, &FrameCounts::unmatched, released);
    } else {
      ++i;
    }
  }
  inbox.counts.used += fresh ? 1 : 0;
  if (fresh && holds) released.add(std::exchange(inbox.held, frame));
  set.held[partner] = frame && !fresh;
  set.frames[partner] = std::move(frame);
  return set.frames[partner] && is_of_moment(set.frames[partner]->metadata, paced);
}

FrameSet FrameMatcher::assemble(std::size_t pacer, TimePoint now, ReleasedFrames& released) {
  Inbox& pacing_inbox = inboxes_[pacer];
  const Frame paced = pacing_inbox.pop(0);
  const FrameMetadata& metadata = paced->metadata;
  ++pacing_inbox.counts.used;
  if (settings_.policies[pacer] == SyncPolicy::Hold) {
    released.add(std::exchange(pacing_inbox.held, paced));
  }
  FrameSet set;
  set.id = ++sets_;
  set.stamp = metadata.exposure_start;
  set.trigger = metadata.trigger;
  set.frames[pacer] = paced;
  if (set.trigger) last_trigger_ = set.trigger;
  last_stamp_ = set.stamp;
  TimePoint first = set.stamp;
  TimePoint last = set.stamp;
  for (std::size_t i = 0; i < cameras_; ++i) {
    if (i == pacer) continue;
    if (join(i, metadata, now, set, released)) {
      first = std::min(first, set.frames[i]->metadata.exposure_start);
      last = std::max(last, set.frames[i]->metadata.exposure_start);
    } else if (inboxes_[i].delivers) {
      set.matched = false;
    }
  }
  set.skew = last - first;
  return set;
}

}  // namespace orbwatch::hal
