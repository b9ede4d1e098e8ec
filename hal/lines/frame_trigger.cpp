// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/frame_trigger.h"

#include <algorithm>
#include <utility>

namespace orbwatch::hal {

FrameTrigger::FrameTrigger(const TriggerSettings& settings, Expose expose)
    : settings_(settings), expose_(std::move(expose)) {}

bool FrameTrigger::is_trigger(Edge edge) const {
  const auto wanted = settings_.activation;
  if (wanted == TriggerActivation::AnyEdge) return true;
  return (wanted == TriggerActivation::RisingEdge) == (edge == Edge::Rising);
}

void FrameTrigger::on_edge(const EdgeEvent& edge) {
  if (is_trigger(edge.edge)) fire(edge.stamp);
}

void FrameTrigger::fire(TimePoint moment) {
  const std::lock_guard lock(mutex_);
  const TriggerStamp trigger{++counts_.triggers, moment};
  if (counts_.waiting == kMaxWaiting) {
    ++counts_.missed;
    // Until a later one is due, the oldest may still get its frame.
    if (settings_.mode == TriggerMode::Software || waiting_[1].moment > moment) return;
    drop_oldest(1);
  }
  waiting_[counts_.waiting++] = {trigger, moment + settings_.delay, false};
}

/// In mode Software, the moment of the first trigger without an exposure request.
TimePoint FrameTrigger::due() const {
  if (settings_.mode != TriggerMode::Software) return TimePoint::max();
  const std::lock_guard lock(mutex_);
  const std::size_t next = counts_.waiting > 0 && waiting_[0].exposed ? 1 : 0;
  return next < counts_.waiting ? waiting_[next].moment : TimePoint::max();
}

void FrameTrigger::run(TimePoint now) {
  while (due() <= now) {
    std::uint64_t id = 0;
    if (!prepare_exposure(now, id) || expose_()) continue;
    const std::lock_guard lock(mutex_);
    if (counts_.waiting == 0 || waiting_[0].trigger.id != id) continue;
    drop_oldest(1);
    ++counts_.missed;
  }
}

/// Handles the trigger that is due; returns true if the camera is to be triggered.
bool FrameTrigger::prepare_exposure(TimePoint now, std::uint64_t& id) {
  const std::lock_guard lock(mutex_);
  if (counts_.waiting == 0) return false;  // abandoned meanwhile
  if (waiting_[0].exposed) {
    ++counts_.missed;
    if (now - waiting_[0].moment <= settings_.timeout) {
      std::swap(waiting_[0], waiting_[1]);  // the new trigger is missed
      drop_oldest(1);
      return false;
    }
    drop_oldest(1);
  }
  waiting_[0].moment = now;
  waiting_[0].exposed = true;
  id = waiting_[0].trigger.id;
  return true;
}

std::optional<TriggerStamp> FrameTrigger::claim(TimePoint exposure_start) {
  const std::lock_guard lock(mutex_);
  const auto trigger = take(exposure_start);
  if (trigger) ++counts_.frames;
  return trigger;
}

bool FrameTrigger::miss(TimePoint exposure_start) {
  const std::lock_guard lock(mutex_);
  const auto trigger = take(exposure_start);
  if (trigger) ++counts_.missed;
  return trigger.has_value();
}

/// Removes and returns the trigger of an exposure from the waiting ones. Call with the lock held.
std::optional<TriggerStamp> FrameTrigger::take(TimePoint exposure_start) {
  const bool software = settings_.mode == TriggerMode::Software;
  if (!software) miss_before(exposure_start - settings_.timeout);
  std::size_t due = 0;  // number of triggers at or before the exposure
  while (due < counts_.waiting && waiting_[due].moment <= exposure_start &&
         (!software || waiting_[due].exposed)) {
    ++due;
  }
  if (!software && may_have_begun(due, exposure_start)) ++due;
  if (due == 0) {
    ++counts_.untriggered;
    return std::nullopt;
  }
  const TriggerStamp trigger = waiting_[due - 1].trigger;
  drop_oldest(due);
  counts_.missed += due - 1;
  return trigger;
}

/// Counts triggers from before `oldest` as missed. Call with the lock held.
void FrameTrigger::miss_before(TimePoint oldest) {
  std::size_t old = 0;
  while (old < counts_.waiting && waiting_[old].moment < oldest) ++old;
  drop_oldest(old);
  counts_.missed += old;
}

/// True if the first trigger after the exposure's start may have begun it nevertheless.
bool FrameTrigger::may_have_begun(std::size_t next, TimePoint exposure_start) const {
  if (next == counts_.waiting) return false;
  const Clock::duration after = waiting_[next].moment - exposure_start;
  const bool is_nearer = next == 0 || after < exposure_start - waiting_[next - 1].moment;
  return is_nearer && after < kStampError;
}

void FrameTrigger::abandon() {
  const std::lock_guard lock(mutex_);
  counts_.missed += counts_.waiting;
  drop_oldest(counts_.waiting);
}

TriggerCounts FrameTrigger::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

void FrameTrigger::drop_oldest(std::size_t count) {
  std::move(waiting_.begin() + static_cast<std::ptrdiff_t>(count),
            waiting_.begin() + static_cast<std::ptrdiff_t>(counts_.waiting), waiting_.begin());
  counts_.waiting -= count;
}

}  // namespace orbwatch::hal
