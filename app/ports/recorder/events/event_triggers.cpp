// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_triggers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace orbwatch::app::recorder {
namespace {

/// Time for which pictures of an event may be late while no frame set arrives.
constexpr std::chrono::seconds kLatest{2};

/// Stores a value that is known; true: it differs from the last known one.
bool changes(double& last, double value) {
  if (std::isnan(value)) return false;
  const double before = std::exchange(last, value);
  return !std::isnan(before) && before != value;
}

}  // namespace

EventTriggers::EventTriggers(const EventSettings& settings,
                             const std::vector<std::string>& process_inputs, FrameRing& ring,
                             Started& started)
    : settings_(settings), ring_(ring), started_(started) {
  for (const std::string& name : settings.on_lines) {
    const auto found = std::ranges::find(process_inputs, name);
    WatchedLine& line = lines_.emplace_back();
    line.input = static_cast<std::size_t>(found - process_inputs.begin());
  }
}

void EventTriggers::accept(const AlarmNotice& notice) {
  if (!settings_.on_alarm || notice.event.kind != signals::AlarmEventKind::Raised) return;
  fire({TriggerKind::Alarm, notice.stamp, notice.frame_set, notice.recipe, notice.part,
        notice.layer, notice});
}

void EventTriggers::accept(const Status& status, hal::TimePoint now) {
  end_before(now - kLatest);
  if (status.frame_set == 0) return;
  const bool is_new_set = status.frame_set != newest_.frame_set;
  newest_ = trigger_at(status);
  collect(status);
  if (is_due(is_new_set, now)) fire_waiting();
}

/// Keeps the causes since the last status, which wait for a frame set.
void EventTriggers::collect(const Status& status) {
  const MachineValues& machine = status.machine.values;
  if (changes(laser_, machine.laser_on) && machine.laser_on != 0) is_laser_ = settings_.on_laser;
  if (changes(layer_, machine.layer)) is_layer_ = settings_.on_layer;
  for (WatchedLine& line : lines_) {
    const std::uint32_t edges = status.process_input_edges[line.input];
    line.waiting += edges - std::exchange(line.edges, edges).value_or(edges);
  }
}

bool EventTriggers::has_cause() const {
  return is_requested_ || is_laser_ || is_layer_ ||
         std::ranges::any_of(lines_, [](const WatchedLine& line) { return line.waiting > 0; });
}

/// True for the first status of a frame set. Later ones repeat its stamp, but the causes of their
/// triggers are not in its pictures: these wait for the next set. If the cameras are gone or not
/// triggered, that set would lie behind the end of the event: then the newest pictures are taken.
bool EventTriggers::is_due(bool is_new_set, hal::TimePoint now) {
  if (is_new_set) return true;
  if (!has_cause()) return false;
  if (!waits_since_) waits_since_ = now;
  return now - *waits_since_ > std::max<hal::Clock::duration>(settings_.after, kLatest);
}

void EventTriggers::fire_waiting() {
  if (newest_.frame_set == 0) return;
  waits_since_.reset();
  if (std::exchange(is_laser_, false)) fire_at_newest(TriggerKind::Laser);
  if (std::exchange(is_layer_, false)) fire_at_newest(TriggerKind::Layer);
  fire_lines();
  if (is_requested_.exchange(false)) fire_at_newest(TriggerKind::Command);
}

/// Several edges of a line are one trigger and further ones that extend it.
void EventTriggers::fire_lines() {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const std::uint32_t edges = std::exchange(lines_[i].waiting, 0U);
    if (edges == 0) continue;
    fire_at_newest(TriggerKind::Line, i);
    extended_ += edges - 1;
  }
}

void EventTriggers::fire_at_newest(TriggerKind kind, std::size_t line) {
  Trigger trigger = newest_;
  trigger.kind = kind;
  trigger.line = line;
  fire(trigger);
}

Trigger EventTriggers::trigger_at(const Status& status) {
  Trigger trigger;
  trigger.stamp = status.stamp;
  trigger.frame_set = status.frame_set;
  trigger.recipe = status.recipe;
  trigger.part = status.machine.part;
  trigger.layer = status.machine.values.layer;
  return trigger;
}

/// False: none runs, it would become too long, or the recorder gave it up.
bool EventTriggers::extends_newest(hal::TimePoint last) {
  if (count_ == 0) return false;
  Running& newest = running_[count_ - 1];
  if (last > newest.last && last - newest.first > settings_.longest) return false;
  newest.last = std::max(newest.last, last);
  return ring_.extend(newest.window, newest.last);
}

void EventTriggers::fire(const Trigger& trigger) {
  const hal::TimePoint first = trigger.stamp - settings_.before;
  const hal::TimePoint last = trigger.stamp + settings_.after;
  if (extends_newest(last)) {
    ++extended_;
    return;
  }
  const auto window = ring_.hold(first, last);
  if (!window) {
    ++refused_;
    return;
  }
  running_[count_++] = {window->number, first, last};
  started_.put({*window, trigger, first});
}

/// The newest event ends last: it began with a later trigger than those of the others.
void EventTriggers::end_before(hal::TimePoint moment) {
  std::size_t ended = 0;
  while (ended < count_ && running_[ended].last < moment) ring_.close(running_[ended++].window);
  std::shift_left(running_.begin(), running_.begin() + count_, ended);
  count_ -= ended;
}

}  // namespace orbwatch::app::recorder
