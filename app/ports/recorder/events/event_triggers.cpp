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
    lines_.push_back({static_cast<std::size_t>(found - process_inputs.begin()), {}});
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
  const MachineValues& machine = status.machine.values;
  const bool is_laser = changes(laser_, machine.laser_on) && machine.laser_on != 0;
  const bool is_layer = changes(layer_, machine.layer);
  if (is_laser && settings_.on_laser) fire(trigger_at(status, TriggerKind::Laser));
  if (is_layer && settings_.on_layer) fire(trigger_at(status, TriggerKind::Layer));
  accept_lines(status);
  if (is_requested_.exchange(false)) fire(trigger_at(status, TriggerKind::Command));
}

/// Several edges of a line since the last status are one trigger and further ones that extend it.
void EventTriggers::accept_lines(const Status& status) {
  for (std::size_t i = 0; i < lines_.size(); ++i) {
    const std::uint32_t edges = status.process_input_edges[lines_[i].input];
    const std::uint32_t before = std::exchange(lines_[i].edges, edges).value_or(edges);
    if (edges == before) continue;
    Trigger trigger = trigger_at(status, TriggerKind::Line);
    trigger.line = i;
    fire(trigger);
    extended_ += edges - before - 1;
  }
}

Trigger EventTriggers::trigger_at(const Status& status, TriggerKind kind) {
  Trigger trigger;
  trigger.kind = kind;
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
