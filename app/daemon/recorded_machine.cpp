// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/recorded_machine.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>

#include "app/model/machine/machine_state.h"
#include "app/ports/recorder/recorded_states.h"
#include "hal/recording/camera_recording.h"

namespace orbwatch::app::daemon {
namespace {

using recorder::Figure;

/// Sets a status from the figures of a recording, which are named like its fields.
class StatusReader {
 public:
  StatusReader(const std::vector<Figure>& figures, MachineStatus& machine)
      : figures_(figures), machine_(machine) {}

  template <class Get>
  void operator()(const Field<Get>& field) {
    const auto found = std::ranges::find(figures_, field.name, &Figure::name);
    if (found == figures_.end() || !result_) return;
    if (std::isinf(found->value)) {
      result_ = fail(found->name + " must be a number");
    } else {
      take(field.get, *found);
    }
  }

  /// Error: a value that a machine cannot have.
  Result<> finish() const {
    if (!result_) return result_;
    MachineState state;
    state.part = machine_.part;
    state.values = machine_.values;
    return check(state);
  }

 private:
  void take(double MachineStatus::*member, const Figure& figure) {
    machine_.*member = figure.value;
  }
  void take(const MachineValueOf& value, const Figure& figure) {
    machine_.values.*value.member = figure.value;
  }
  void take(MachineQuality MachineStatus::*member, const Figure& figure) {
    constexpr auto kLast = static_cast<double>(MachineQuality::Stale);
    const bool is_one = figure.value >= 0 && figure.value <= kLast;
    if (is_one) machine_.*member = static_cast<MachineQuality>(figure.value);
    if (!is_one) result_ = fail("quality must be from 0 to 4");
  }
  void take(hal::TimePoint MachineStatus::*member, const Figure& figure) {
    if (std::isnan(figure.value)) return;
    const bool is_age = figure.value >= kAge.minimum && figure.value <= kAge.maximum;
    if (!is_age) result_ = fail(figure.name + " must be an age");
    if (is_age) machine_.*member = at_epoch(-figure.value);
  }
  void take(PartName MachineStatus::*member, const Figure& figure) {
    const auto part = PartName::make(figure.text);
    if (part) machine_.*member = *part;
    if (!part) result_ = tl::unexpected(part.error());
  }
  /// Counts are those of the recording's appliance.
  void take(std::uint64_t MachineStatus::*, const Figure&) {}

  static hal::TimePoint at_epoch(double seconds) {
    const std::chrono::duration<double> since(seconds);
    return hal::TimePoint(std::chrono::duration_cast<hal::Clock::duration>(since));
  }

  const std::vector<Figure>& figures_;
  MachineStatus& machine_;
  Result<> result_;
};

/// The machine in a state of the process; nullopt: it is not in it.
Result<std::optional<MachineStatus>> machine_in(const recorder::ProcessState& state) {
  const auto found = std::ranges::find(state.components, std::string_view("machine"),
                                       &recorder::ComponentFigures::kind);
  if (found == state.components.end()) return std::nullopt;
  MachineStatus machine;
  StatusReader reader(found->figures, machine);
  for_each_field(std::type_identity<MachineStatus>{}, reader);
  if (auto read = reader.finish(); !read) return tl::unexpected(read.error());
  if (machine.quality == MachineQuality::NotConfigured) return std::nullopt;
  return machine;
}

/// Stamp of the frame set that new frames were recorded in; 0: none of them was recorded.
std::uint64_t recorded_set_of(const hal::FrameSet& set) {
  std::uint64_t newest = 0;
  for (std::size_t i = 0; i < set.frames.size(); ++i) {
    const bool is_new = set.frames[i] && !set.held[i];
    if (is_new) newest = std::max(newest, set.frames[i]->metadata.recorded_set);
  }
  return newest;
}

}  // namespace

Result<std::filesystem::path> replayed_recording(const files::Resolved& site) {
  std::filesystem::path recording;
  for (const files::CameraSettings& camera : site.site.cameras) {
    const auto* const replay = std::get_if<hal::ReplaySettings>(&camera.back_end);
    if (replay == nullptr || !hal::recording::has_recording_name(replay->source)) continue;
    if (!recording.empty() && recording != replay->source) {
      return fail("machine.source is recording, but the cameras replay two: " + recording.string() +
                  " and " + replay->source.string());
    }
    recording = replay->source;
  }
  if (!recording.empty()) return recording;
  return fail(
      "machine.source is recording, but no camera replays one; set back_end = \"replay\" with an "
      "MCAP file as source");
}

RecordedMachine::RecordedMachine(std::filesystem::path recording, hal::Clock::duration timeout)
    : recording_(std::move(recording)), timeout_(timeout) {
  status_.forget(MachineQuality::NoState);
}

Result<> RecordedMachine::load() {
  auto states = recorder::RecordedStates::open(recording_);
  if (!states) return tl::unexpected(states.error());
  const auto refuse = [&](const std::string& reason) {
    return fail(recording_.string() + ": " + reason);
  };
  std::vector<State> read;
  while (true) {
    const auto state = states->next();
    if (!state) return tl::unexpected(state.error());
    if (!*state) break;
    auto machine = machine_in((*state)->state);
    if (!machine) {
      return refuse("state " + std::to_string(states->count() - 1) +
                    " of the machine: " + machine.error().message);
    }
    if (!*machine) continue;
    if (read.size() == kMostStates) {
      return refuse("more than " + std::to_string(kMostStates) + " states of the machine");
    }
    read.push_back({(*state)->utc, **machine});
  }
  if (read.empty()) return refuse("no states of a machine");
  std::ranges::stable_sort(read, {}, &State::set_time);
  states_ = std::move(read);
  is_loaded_ = true;
  return {};
}

/// The state of the recorded frame set; null: it has none.
const RecordedMachine::State* RecordedMachine::find(std::uint64_t set_time) const {
  if (!is_loaded_) return nullptr;
  const auto found = std::ranges::lower_bound(states_, set_time, {}, &State::set_time);
  return found != states_.end() && found->set_time == set_time ? &*found : nullptr;
}

const MachineStatus& RecordedMachine::follow(const hal::FrameSet& set) {
  const std::uint64_t set_time = recorded_set_of(set);
  if (set_time == 0) return keep(set.stamp);
  newest_ = set.stamp;
  const std::uint64_t count = status_.states;
  const State* const found = find(set_time);
  if (found == nullptr) {
    status_.forget(MachineQuality::NoState);
    return status_;
  }
  const bool has_moment = found->machine.state != hal::TimePoint{};
  status_ = found->machine;
  if (has_moment) status_.state = set.stamp + found->machine.state.time_since_epoch();
  status_.states = count + 1;
  return status_;
}

const MachineStatus& RecordedMachine::keep(hal::TimePoint now) {
  const bool is_stale = status_.quality != MachineQuality::NoState && now - newest_ > timeout_;
  if (is_stale) status_.forget(MachineQuality::Stale);
  return status_;
}

}  // namespace orbwatch::app::daemon
