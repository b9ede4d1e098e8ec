// SPDX-License-Identifier: Apache-2.0
#include "app/machine/state_track.h"

#include <cmath>

namespace orbwatch::app::machine {
namespace {

double seconds(hal::Clock::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// The line through two values of a turned axis: the shorter way round.
double turn(double from, double to) { return std::remainder(to - from, 360.0); }

/// The value at the share `t` of the way from `a` to `b`; beyond 1 it is continued.
double between(const MachineValue& value, const TimedState& a, const TimedState& b, double t) {
  const double from = a.values.*value.get, to = b.values.*value.get;
  switch (value.between) {
    case Between::Held:
      break;
    case Between::Interpolated:
      return from + t * (to - from);
    case Between::Turned:
      return from + t * turn(from, to);
  }
  return t >= 1 ? to : from;
}

/// Sets values and motion on the line through two states of different moments.
void set_motion(const TimedState& a, const TimedState& b, hal::TimePoint moment,
                MachineStatus& machine) {
  const double step = seconds(b.moment - a.moment);
  const double t = seconds(moment - a.moment) / step;
  for (const MachineValue& value : kMachineValues) {
    machine.values.*value.get = between(value, a, b, t);
  }
  machine.vx = (b.values.x - a.values.x) / step;
  machine.vy = (b.values.y - a.values.y) / step;
  machine.vz = (b.values.z - a.values.z) / step;
  const optics::Vec3 tool = a.tool + (b.tool - a.tool) * t;
  const double length = optics::norm(tool);
  machine.tool_x = tool.x / length;
  machine.tool_y = tool.y / length;
  machine.tool_z = tool.z / length;
}

}  // namespace

void StateTrack::add(const TimedState& state) {
  while (size_ > 0 && at(size_ - 1).moment >= state.moment) --size_;
  if (size_ == kCapacity) {
    first_ = (first_ + 1) % kCapacity;
    --size_;
  }
  states_[(first_ + size_) % kCapacity] = state;
  ++size_;
}

std::size_t StateTrack::count_until(hal::TimePoint moment) const {
  std::size_t low = 0, high = size_;
  while (low < high) {
    const std::size_t middle = (low + high) / 2;
    if (at(middle).moment <= moment) {
      low = middle + 1;
    } else {
      high = middle;
    }
  }
  return low;
}

const TimedState* StateTrack::before(hal::TimePoint moment) const {
  const std::size_t count = count_until(moment);
  return count > 0 ? &at(count - 1) : nullptr;
}

const TimedState* StateTrack::after(hal::TimePoint moment) const {
  const std::size_t count = count_until(moment);
  return count < size_ ? &at(count) : nullptr;
}

bool StateTrack::is_silent(hal::TimePoint now) const {
  return size_ == 0 || now - at(size_ - 1).moment > silence_;
}

void StateTrack::report(hal::TimePoint moment, MachineStatus& machine) const {
  const std::size_t count = count_until(moment);
  machine.state = count > 0 ? at(count - 1).moment : hal::TimePoint{};
  if (count == 0) return machine.forget(MachineQuality::NoState);
  const TimedState& before = at(count - 1);
  const bool has_after = count < size_;
  const bool is_stale =
      has_after ? at(count).moment - before.moment > timeout_ : moment - before.moment > silence_;
  if (is_stale) return machine.forget(MachineQuality::Stale);
  machine.quality = has_after ? MachineQuality::Good : MachineQuality::Predicted;
  machine.part = before.part;
  if (has_after) return set_motion(before, at(count), moment, machine);
  const bool has_velocity = count > 1 && before.moment - at(count - 2).moment <= timeout_;
  if (has_velocity) return set_motion(at(count - 2), before, moment, machine);
  // A single state says nothing about motion.
  machine.forget(MachineQuality::Predicted);
  machine.part = before.part;
  for (const MachineValue& value : kMachineValues) {
    if (value.between == Between::Held) machine.values.*value.get = before.values.*value.get;
  }
}

}  // namespace orbwatch::app::machine
