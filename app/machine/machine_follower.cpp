// SPDX-License-Identifier: Apache-2.0
#include "app/machine/machine_follower.h"

#include <cmath>
#include <mutex>
#include <numbers>

#include "app/log.h"
#include "proc/optics/rotation.h"

namespace orbwatch::app::machine {
namespace {

/// The vector turned about x, then y, then z; an unknown angle counts as 0.
optics::Vec3 turned(optics::Vec3 v, const MachineValues& angles) {
  const auto turn = [](double degrees, double& from, double& to) {
    const double angle = signals::is_valid(degrees) ? degrees * std::numbers::pi / 180 : 0;
    const double c = std::cos(angle), s = std::sin(angle);
    const double turned_from = c * from - s * to;
    to = s * from + c * to;
    from = turned_from;
  };
  turn(angles.a, v.y, v.z);
  turn(angles.b, v.z, v.x);
  turn(angles.c, v.x, v.y);
  return v;
}

/// The sum of the coordinates by their weights; unknown only if one that counts is, because axes
/// that a controller does not have are unknown.
double weighted(const optics::Vec3& weights, const optics::Vec3& v) {
  const auto term = [](double weight, double value) {
    constexpr double kRounding = 1e-12;  // of the cosine of a right angle
    return std::abs(weight) < kRounding ? 0 : weight * value;
  };
  return term(weights.x, v.x) + term(weights.y, v.y) + term(weights.z, v.z);
}

}  // namespace

MachineFollower::MachineFollower(const MachineSettings& settings)
    : settings_(settings),
      rotation_(
          optics::rotation({settings.rotation[0], settings.rotation[1], settings.rotation[2]})),
      track_(settings.timeout, settings.delay) {
  if (settings_.source != MachineSource::None) status_.forget(MachineQuality::NoState);
}

MachinePath MachineFollower::path() {
  return {settings_.source,
          [this](const MachineState& state) { return take(state, hal::Clock::now()); },
          [this](const Error& error) { refuse(error, hal::Clock::now()); }};
}

TimedState MachineFollower::in_machine_frame(const MachineState& state) const {
  TimedState placed{{}, state.part, state.values, {}};
  MachineValues& v = placed.values;
  const optics::Vec3 position{v.x, v.y, v.z};
  v.x = weighted(rotation_.row0, position) + settings_.origin.x;
  v.y = weighted(rotation_.row1, position) + settings_.origin.y;
  v.z = weighted(rotation_.row2, position) + settings_.origin.z;
  const optics::Vec3 axis = settings_.tool_axis * (1 / optics::norm(settings_.tool_axis));
  placed.tool = rotation_ * turned(axis, state.values);
  return placed;
}

Result<> MachineFollower::take(const MachineState& state, hal::TimePoint arrival) {
  const auto checked = check(state);
  if (!checked) {
    refuse(checked.error(), arrival);
    return checked;
  }
  const TimedState placed = in_machine_frame(state);
  {
    const std::lock_guard lock(mutex_);
    if (state.sequence && state.sequence == sequence_) return {};
    sequence_ = state.sequence;
    ++states_;
    add(state, placed, arrival);
  }
  say_clock(arrival);
  return {};
}

void MachineFollower::add(const MachineState& state, TimedState placed, hal::TimePoint arrival) {
  const bool has_clock = signals::is_valid(state.clock);
  const auto moment = has_clock ? clock_.moment_of(state.clock, arrival) : arrival;
  if (!moment) return;
  placed.moment = *moment - settings_.delay;
  track_.add(placed);
}

void MachineFollower::say_clock(hal::TimePoint now) {
  {
    const std::lock_guard lock(mutex_);
    if (!clock_.stands(now) || now < next_clock_log_) return;
    next_clock_log_ = now + std::chrono::hours(1);
  }
  log_soon(LogLevel::Warning,
           {"machine: the controller's clock does not advance, or in steps of more than 50 ms; its "
            "states count at their arrival. A controller without a clock sends none: over DDS NaN, "
            "over Modbus 4294967295"});
}

void MachineFollower::refuse(const Error& error, hal::TimePoint now) {
  {
    const std::lock_guard lock(mutex_);
    ++refused_;
    if (now < next_log_) return;
    next_log_ = now + std::chrono::seconds(1);
  }
  log_soon(LogLevel::Warning, {"a state of the machine is refused: ", error.message});
}

const MachineStatus& MachineFollower::follow(hal::TimePoint moment,
                                             std::optional<std::uint64_t> trigger) {
  const MachineQuality before = status_.quality;
  {
    const std::lock_guard lock(mutex_);
    track_.report(moment, status_);
    if (trigger) {
      status_.slips += static_cast<std::uint64_t>(triggers_.slips(track_, *trigger, moment));
    }
    status_.states = states_;
    status_.refused = refused_;
  }
  say_quality(before);
  return status_;
}

const MachineStatus& MachineFollower::keep(hal::TimePoint now) {
  const MachineQuality before = status_.quality;
  {
    const std::lock_guard lock(mutex_);
    if (states_ > 0) update_fault(now);
    status_.states = states_;
    status_.refused = refused_;
  }
  say_quality(before);
  return status_;
}

void MachineFollower::update_fault(hal::TimePoint now) {
  if (track_.is_silent(now)) return status_.forget(MachineQuality::Stale);
  if (!is_fault(status_.quality)) return;
  track_.report(now, status_);
  status_.forget(status_.quality);  // values at `now` are not those of the last exposure
}

void MachineFollower::say_quality(MachineQuality before) const {
  if (is_fault(before) == is_fault(status_.quality)) return;
  const bool is_lost = is_fault(status_.quality);
  log_soon(is_lost ? LogLevel::Warning : LogLevel::Info,
           {"machine: ", operator_text(status_.quality)});
}

}  // namespace orbwatch::app::machine
