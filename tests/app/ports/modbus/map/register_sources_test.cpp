// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "app/ports/modbus/map/bits.h"
#include "tests/app/ports/modbus/map/full_image.h"

/// Tests that every register depends on its source only.
namespace orbwatch::app::modbus {
namespace {

using std::chrono::milliseconds;
using Names = std::set<std::string>;

std::string numbered(const std::string& thing, std::size_t number, const std::string& what) {
  return thing + "_" + std::to_string(number) + "_" + what;
}

/// `name` of every region, in the live block or the window of results.
Names of_regions(const std::string& block, const Names& names) {
  Names all;
  for (std::size_t i = 0; i < signals::kMaxRegions; ++i) {
    for (const std::string& name : names) all.insert(numbered(block, i, name));
  }
  return all;
}

Names operator+(Names a, const Names& b) {
  a.insert(b.begin(), b.end());
  return a;
}

/// Name of the word with the valid bit of this signal; each block begins with one.
std::string valid_word(std::size_t signal) {
  const std::size_t first = signal < kFirstSignals ? 0 : kFirstSignals;
  return "valid_" + std::to_string(first + (signal - first) / 16 * 16);
}

class RegisterSources : public testing::Test {
 protected:
  /// Expects that this change of the image changes exactly these registers.
  void expect(const std::function<void(ProcessImage&)>& change, const Names& names) {
    ProcessImage after = before_;
    change(after);
    const auto codes = own_.contents(after);
    Names changed;
    for (std::size_t i = 0; i < codes.size(); ++i) {
      if (codes[i] != codes_before_[i]) changed.insert(own_.names[i]);
    }
    EXPECT_EQ(changed, names);
    covered_ = covered_ + names;
  }

  /// Expects the rows block_n_... of all regions to follow `stamped`.
  void expect_measured(const std::string& block, StampedStatus& (*stamped)(ProcessImage&),
                       const Names& also_live);
  void expect_regions(const std::string& block, StampedStatus& (*stamped)(ProcessImage&));
  void expect_system();
  void expect_status();
  void expect_cameras_and_views();
  void expect_alarms();
  void expect_health();
  void expect_machine(const std::string& block, StampedStatus& (*stamped)(ProcessImage&));
  void expect_server_and_plc();

  const Registers own_;
  const ProcessImage before_ = full_image();
  const std::vector<std::uint32_t> codes_before_ = own_.contents(before_);
  Names covered_;
};

void RegisterSources::expect_measured(const std::string& block,
                                      StampedStatus& (*stamped)(ProcessImage&),
                                      const Names& also_live) {
  const auto of = [&](const std::string& name) {
    return of_regions(block, {name}) +
           (also_live.contains(name) ? Names{"system_" + name} : Names{});
  };
  expect([&](ProcessImage& s) { ++stamped(s).status.result; },
         of("result") + of_regions(block, {"more_1_result"}));
  expect([&](ProcessImage& s) { ++stamped(s).status.frame_set; },
         of("frame_set") + of_regions(block, {"more_1_frame_set"}));
  expect([&](ProcessImage& s) { ++stamped(s).status.trigger; }, of("trigger"));
  expect([&](ProcessImage& s) { ++stamped(s).status.recipe; }, of("recipe"));
  expect([&](ProcessImage& s) { ++stamped(s).status.configuration_checksum; },
         of("configuration_checksum"));
  const bool live = !also_live.empty();
  expect([&](ProcessImage& s) { stamped(s).utc += std::chrono::microseconds(3'000'001); },
         of_regions(block, {"utc_seconds", "utc_microseconds"}) +
             (live ? Names{"utc_seconds", "utc_microseconds"} : Names{}));
  expect([&](ProcessImage& s) { stamped(s).status.process_active = false; },
         of_regions(block, {"process_active"}) +
             (live ? Names{"process_active?", "system_process_active", "status_bits"} : Names{}));
}

void RegisterSources::expect_regions(const std::string& block,
                                     StampedStatus& (*stamped)(ProcessImage&)) {
  const bool live = block == "region";
  for (std::size_t i = 0; i < signals::kMaxRegions; ++i) {
    const auto name = [&](std::string_view what) { return numbered(block, i, std::string(what)); };
    const auto region = [&](ProcessImage& s) -> RegionStatus& {
      return stamped(s).status.regions[i];
    };
    expect([&](ProcessImage& s) { region(s).quality = Quality::Apparent; }, {name("quality")});
    expect(
        [&](ProcessImage& s) { region(s).quality = Quality::NotMeasured; },
        Names{name("quality")} + (live ? Names{name("measured?"), "measurement_bits"} : Names{}));
    for (std::size_t n = 0; n < signals::kSignals.size(); ++n) {
      const signals::SignalInfo& signal = signals::kSignals[n];
      const Names hot_spot = live && signal.member == &signals::Signals::hot_spot_present
                                 ? Names{name("hot_spot?"), "measurement_bits"}
                                 : Names{};
      expect([&](ProcessImage& s) { region(s).signals.*signal.member = signal.minimum; },
             Names{name(signal.name)} + hot_spot);
      expect([&](ProcessImage& s) { region(s).signals.*signal.member = signals::kNotValid; },
             Names{name(signal.name), name(valid_word(n))} + hot_spot);
    }
    // An active alarm in this region.
    AlarmStatus alarm{.alarm = {signals::AlarmState::Acknowledged, signals::AlarmLevel::LowWarning,
                                signals::AlarmLevel::LowWarning, false},
                      .region = static_cast<std::uint16_t>(i)};
    if (live) continue;  // tested with the alarms
    expect(
        [&](ProcessImage& s) {
          stamped(s).status.alarms[9] = alarm;
          stamped(s).status.alarm_count = 10;
        },
        {name("alarm_severity")});
  }
}

void RegisterSources::expect_system() {
  const auto to_state = [this](SystemState state, const Names& names) {
    expect([state](ProcessImage& s) { s.live.status.state = state; },
           Names{"system_state", "status_bits", "running?"} + names);
  };
  to_state(SystemState::Starting, {});
  to_state(SystemState::Degraded, {"degraded?"});
  to_state(SystemState::Fault, {"fault?", "fault_bits"});
  to_state(SystemState::Stopped, {"stopped?"});
  Names deliver;
  for (std::size_t i = 0; i < kMaxCameras; ++i) deliver.insert(numbered("camera", i, "delivers?"));
  expect([](ProcessImage& s) { s.stale = true; },
         deliver + Names{"stale?", "status_bits", "fault_bits", "measurement_bits"});
  Names ages{"system_stamp_age", "plc_heartbeat_age", "machine_state_age",
             "result_machine_state_age"};
  for (std::size_t i = 0; i < kMaxCameras; ++i)
    ages.insert(numbered("camera", i, "last_frame_age"));
  for (std::size_t i = 1; i <= signals::kMaxAlarms; ++i)
    ages.insert(numbered("alarm", i, "since_age"));
  expect([](ProcessImage& s) { s.now += std::chrono::seconds(2); }, ages);
  expect([](ProcessImage& s) { s.server.uptime += 2; }, {"modbus_uptime"});
}

void RegisterSources::expect_status() {
  using S = ProcessImage&;
  expect([](S s) { ++s.live.status.heartbeat; }, {"system_heartbeat"});
  expect([](S s) { s.live.status.stamp -= milliseconds(7); }, {"system_stamp_age"});
  expect([](S s) { ++s.live.status.overruns; }, {"system_overruns"});
  expect([](S s) { ++s.live.status.unmatched; }, {"system_unmatched"});
  expect([](S s) { s.live.status.skew_ms = 1.2; }, {"system_skew_ms"});
  expect([](S s) { s.live.status.load = 0.5; }, {"system_load"});
  expect([](S s) { s.live.status.load = 1.5; }, {"system_load", "fault_bits"});
  expect([](S s) { ++s.live.status.selected_view; }, {"system_selected_view"});
  expect([](S s) { ++s.live.status.process_inputs_known; }, {"system_process_inputs_known"});
  expect([](S s) { ++s.live.status.line_faults; }, {"system_line_faults"});
  expect([](S s) { ++s.live.status.interface_faults; }, {"system_interface_faults"});
  expect([](S s) { s.live.status.busy_ms = 1.2; }, {"system_busy_ms"});
  expect([](S s) { s.live.status.realtime = true; }, {"system_realtime"});
  expect([](S s) { s.live.status.memory_locked = true; }, {"system_memory_locked"});
  expect([](S s) { s.live.status.configuration_refused = true; }, {"system_configuration_refused"});
  expect([](S s) { s.live.status.trial_left = 30; }, {"system_trial_left"});
  for (std::size_t i = 0; i < kStages; ++i) {
    const std::string name = "stage_" + std::string(name_of(static_cast<Stage>(i))) + "_";
    expect([i](S s) { s.live.status.stages[i].cpu_ms = 1.2; }, {name + "cpu_ms"});
    expect([i](S s) { s.live.status.stages[i].cpu_p50_ms = 1.2; }, {name + "cpu_p50_ms"});
    expect([i](S s) { s.live.status.stages[i].cpu_p99_ms = 1.2; }, {name + "cpu_p99_ms"});
  }
  for (std::size_t i = 0; i < 32; ++i) {
    expect([i](S s) { s.live.status.process_inputs = 1U << i; },
           {"system_process_inputs", "process_input_" + std::to_string(i) + "?"});
  }
  expect([](S s) { --s.live.status.view_count; }, {"view_count"});
  expect([](S s) { --s.live.status.region_count; }, {"region_count"});
  const std::string last = numbered("camera", kMaxCameras - 1, "");
  expect([](S s) { --s.live.status.camera_count; },
         {"camera_count", last + "fault", last + "delivers?", "measurement_bits"});
  expect([](S s) { --s.live.status.alarm_count; },
         {"alarm_count", numbered("alarm", signals::kMaxAlarms, "state")});
}

void RegisterSources::expect_cameras_and_views() {
  for (std::size_t i = 0; i < kMaxCameras; ++i) {
    const auto expect_of = [&](const std::string& what, auto change, const Names& also = {}) {
      expect([&](ProcessImage& s) { change(s.live.status.cameras[i]); },
             Names{numbered("camera", i, what)} + also);
    };
    using C = CameraStatus&;
    expect_of("fault", [](C c) { c.fault = hal::Fault::Stalled; },
              {numbered("camera", i, "delivers?"), "measurement_bits", "fault_bits"});
    expect_of("frames_per_second", [](C c) { c.frames_per_second = 20; });
    expect_of("latency_p50_ms", [](C c) { c.latency_p50_ms = 1; });
    expect_of("latency_p99_ms", [](C c) { c.latency_p99_ms = 1; });
    expect_of("last_frame_age", [](C c) { c.last_frame -= milliseconds(9); });
    expect_of("last_frame_age", [](C c) { c.last_frame = {}; });
    expect_of("frames", [](C c) { ++c.frames; });
    expect_of("lost", [](C c) { ++c.lost; });
    expect_of("dropped", [](C c) { ++c.dropped; });
    expect_of("unmatched", [](C c) { ++c.unmatched; });
    expect_of("triggers", [](C c) { ++c.triggers; });
    expect_of("missed", [](C c) { ++c.missed; });
    expect_of("damaged", [](C c) { ++c.damaged; });
    expect_of("flawed", [](C c) { ++c.flawed; });
    expect_of("alignment", [](C c) { c.alignment = AlignmentLevel::Alarm; }, {"fault_bits"});
    expect_of("alignment", [](C c) { c.alignment = AlignmentLevel::Learning; });
    expect_of("alignment", [](C c) { c.alignment = AlignmentLevel::NotVisible; });
    expect_of("drift_error", [](C c) { c.drift_error = 1; });
    expect_of("drift_shift", [](C c) { c.drift_shift = 1; });
    expect_of("focus", [](C c) { c.focus = WatchLevel::Alarm; }, {"fault_bits"});
    expect_of("blur", [](C c) { c.blur = 1; });
    expect_of("cleanliness", [](C c) { c.cleanliness = WatchLevel::Alarm; }, {"fault_bits"});
    expect_of("contamination", [](C c) { c.contamination = 1; });
    expect_of("proposal", [](C c) { c.proposal = ProposalState::Ready; });
    expect_of("proposal_error", [](C c) { c.proposal_error = 1; });
    expect_of("marked_points", [](C c) { ++c.marked_points; });
    expect_of("missing_packets", [](C c) { ++c.missing_packets; });
    expect_of("resent_packets", [](C c) { ++c.resent_packets; });
    expect_of("underruns", [](C c) { ++c.underruns; });
    expect_of("outline_check", [](C c) { c.outline_check = OutlineState::Aligned; });
    expect_of("outline_check", [](C c) { c.outline_check = OutlineState::NotAligned; },
              {"fault_bits"});
    expect_of("outline_offset", [](C c) { c.outline_offset = 1; });
    expect_of("outline_offset_px", [](C c) { c.outline_offset_px = 1; });
  }
  for (std::size_t i = 0; i < kMaxViews; ++i) {
    const auto expect_of = [&](const std::string& what, auto change) {
      expect([&](ProcessImage& s) { change(s.live.status.views[i]); }, {numbered("view", i, what)});
    };
    using V = ViewStatus&;
    expect_of("published", [](V v) { ++v.published; });
    expect_of("skipped", [](V v) { ++v.skipped; });
    expect_of("superseded", [](V v) { ++v.superseded; });
    expect_of("frames_per_second", [](V v) { v.frames_per_second = 20; });
    expect_of("latency_p50_ms", [](V v) { v.latency_p50_ms = 1; });
    expect_of("latency_p99_ms", [](V v) { v.latency_p99_ms = 1; });
    expect_of("live", [](V v) { v.live = true; });
  }
}

void RegisterSources::expect_alarms() {
  using signals::AlarmLevel;
  using signals::AlarmState;
  for (std::size_t i = 0; i < signals::kMaxAlarms; ++i) {
    const auto name = [i](const std::string& what) { return numbered("alarm", i + 1, what); };
    const std::size_t region = i % signals::kMaxRegions;
    const Names stands{name("state"), name("region"), name("active?"), "alarms_active"};
    const auto expect_in = [&](AlarmState state, AlarmLevel level, AlarmLevel announced,
                               const Names& names) {
      expect(
          [&](ProcessImage& s) {
            s.live.status.alarms[i].alarm = {state, level, announced, false};
            s.live.status.alarms[i].region = static_cast<std::uint16_t>(region);
          },
          [&] {
            Names all = names;
            if (region == 0) all.erase(name("region"));
            if (announced != AlarmLevel::None) all.insert(name("announced"));
            return all;
          }());
    };
    const std::string severity = numbered("region", region, "alarm_severity");
    const Names severe{"alarm_severity", severity, "status_bits"};
    const Names asks{name("unacknowledged?"), "alarms_unacknowledged", "unacknowledged?"};
    expect_in(AlarmState::Unacknowledged, AlarmLevel::HighAlarm, AlarmLevel::HighAlarm,
              stands + severe + asks + Names{name("level"), "alarm?", "alarms_severe"});
    expect_in(AlarmState::Acknowledged, AlarmLevel::LowWarning, AlarmLevel::LowWarning,
              stands + severe + Names{name("level"), "warning?"});
    // Latched at its level, although its signal has returned.
    expect_in(AlarmState::LatchedUnacknowledged, AlarmLevel::None, AlarmLevel::LowAlarm,
              stands + severe + asks + Names{"alarm?", "alarms_severe"});
    expect_in(AlarmState::ReturnedUnacknowledged, AlarmLevel::None, AlarmLevel::LowAlarm,
              asks + Names{name("state"), name("region"), "status_bits"});
    expect_in(AlarmState::SuppressedByDesign, AlarmLevel::None, AlarmLevel::None,
              {name("state"), name("region")});
    const auto expect_of = [&](const std::string& what, auto change) {
      expect([&](ProcessImage& s) { change(s.live.status.alarms[i]); }, {what});
    };
    expect_of(name("region"), [](AlarmStatus& a) { ++a.region; });
    expect_of(name("signal"), [](AlarmStatus& a) {
      a.signal = static_cast<SignalNumber>(1 + static_cast<int>(a.signal));
    });
    expect_of(name("value"), [](AlarmStatus& a) { a.value = 1; });
    expect_of(name("value"), [](AlarmStatus& a) { a.value = signals::kNotValid; });
    expect_of(name("since_age"), [](AlarmStatus& a) { a.since -= milliseconds(3); });
    expect([&](ProcessImage& s) { s.live.status.alarms[i].alarm.measurement_lost = true; },
           {"alarms_not_measured", name("measurement_lost")});
  }
}

void RegisterSources::expect_health() {
  for (const HealthField& figure : kHealthFigures) {
    Names names{"health_" + std::string(figure.name)};
    if (figure.get == &Health::throttling) names.insert("fault_bits");
    if (figure.get == &Health::commands_recorded) names.insert("fault_bits");
    if (figure.get == &Health::clock_synchronised) {
      names = names + Names{"clock_synchronised?", "status_bits", "fault_bits"};
    }
    const double other =
        before_.live.status.health.*figure.get == figure.minimum ? 1 : figure.minimum;
    expect([&](ProcessImage& s) { s.live.status.health.*figure.get = other; }, names);
  }
  expect([](ProcessImage& s) { s.live.status.health.throttling = 0x10; }, {"health_throttling"});
  expect([](ProcessImage& s) { s.live.status.health.throttling = 0x08; },
         {"health_throttling", "fault_bits"});
  expect([](ProcessImage& s) { s.live.status.health.clock_synchronised = signals::kNotValid; },
         {"health_clock_synchronised", "clock_synchronised?", "status_bits"});
}

void RegisterSources::expect_machine(const std::string& block,
                                     StampedStatus& (*stamped)(ProcessImage&)) {
  const auto expect_member = [&](const std::string& name, auto change, const Names& more = {}) {
    expect([&](ProcessImage& image) { change(stamped(image).status.machine); },
           more + Names{block + name});
  };
  using M = MachineStatus&;
  expect_member(
      "quality", [](M m) { m.quality = MachineQuality::Stale; },
      block == "machine_" ? Names{"fault_bits"} : Names{});
  expect_member("state_age", [](M m) { m.state -= milliseconds(1); });
  for (std::size_t i = 0; i < PartName::kMost / 2; ++i) {
    const std::string name =
        std::string(2 * i, 'x') + "yy" + std::string(PartName::kMost - 2 * i - 2, 'x');
    expect_member("part_" + std::to_string(i), [&](M m) { m.part = *PartName::make(name); });
  }
  for (const MachineValue& value : kMachineValues) {
    expect_member(std::string(value.name), [&](M m) { m.values.*value.get = value.minimum; });
  }
  expect_member("vx", [](M m) { m.vx = 3; });
  expect_member("vy", [](M m) { m.vy = 3; });
  expect_member("vz", [](M m) { m.vz = 3; });
  expect_member("tool_x", [](M m) { m.tool_x = 0.5; });
  expect_member("tool_y", [](M m) { m.tool_y = 0.5; });
  expect_member("tool_z", [](M m) { m.tool_z = 0.5; });
  expect_member("states", [](M m) { ++m.states; });
  expect_member("refused", [](M m) { ++m.refused; });
  expect_member("slips", [](M m) { ++m.slips; });
}

void RegisterSources::expect_server_and_plc() {
  using S = ProcessImage&;
  expect([](S s) { s.live.status.recipe_refused = true; },
         {"recipe_refused?", "system_recipe_refused", "status_bits"});
  expect([](S s) { ++s.results.count; }, {"result_count"});
  expect([](S s) { s.results.count = 0; }, {"result_count", "result_available?", "status_bits"});
  expect([](S s) { ++s.results.overruns; }, {"result_overruns"});
  expect([](S s) { s.results.overrun = true; },
         {"result_overrun?", "result_overrun", "status_bits", "fault_bits"});
  expect([](S s) { ++s.last_acknowledged; }, {"result_acknowledged"});
  expect([](S s) { ++s.server.answered; }, {"modbus_answered"});
  expect([](S s) { ++s.server.refused; }, {"modbus_refused"});
  expect([](S s) { ++s.server.dropped; }, {"modbus_dropped"});
  expect([](S s) { ++s.server.connections; }, {"modbus_connections"});
  expect([](S s) { ++s.server.serial_errors; }, {"modbus_serial_errors"});
  expect([](S s) { ++s.server.serial_other_units; }, {"modbus_serial_other_units"});
  expect([](S s) { ++s.server.serial_echoes; }, {"modbus_serial_echoes"});
  expect([](S s) { s.plc.heartbeat -= milliseconds(1); }, {"plc_heartbeat_age"});
  expect([](S s) { s.plc.alive = true; }, {"plc_alive?", "plc_alive", "status_bits"});
  expect([](S s) { s.plc.silent = true; }, {"plc_silent", "fault_bits"});
  expect([](S s) { ++s.written.heartbeat; }, {"plc_heartbeat"});
  for (std::size_t i = 0; i < kMaxArguments; ++i) {
    expect([i](S s) { --s.written.command.arguments[i]; }, {"argument_" + std::to_string(i)});
  }
  expect([](S s) { ++s.written.command.command; }, {"command"});
  expect([](S s) { ++s.written.command.sequence; }, {"command_sequence"});
  expect([](S s) { ++s.written.command.acknowledged; }, {"acknowledged_sequence"});
  expect([](S s) { s.written.command.result = CommandResult::Busy; }, {"command_result"});
  expect([](S s) { ++s.written.command.last_command; }, {"last_command"});
  for (std::size_t i = 0; i < MachineRegisters().part.size(); ++i) {
    expect([i](S s) { ++s.written.machine.part[i]; }, {"state_part_" + std::to_string(i)});
  }
  expect([](S s) { ++s.written.machine.clock_seconds; }, {"state_clock_seconds"});
  expect([](S s) { ++s.written.machine.clock_microseconds; }, {"state_clock_microseconds"});
  expect([](S s) { ++s.written.machine.sequence; }, {"state_sequence"});
  for (std::size_t i = 0; i < kMachineValues.size(); ++i) {
    expect([i](S s) { ++s.written.machine.values[i]; },
           {"state_" + std::string(kMachineValues[i].name)});
  }
}

TEST_F(RegisterSources, EveryRegisterFollowsItsSourceAndNoOther) {
  StampedStatus& (*const live)(ProcessImage&) = [](ProcessImage& s) -> StampedStatus& {
    return s.live;
  };
  StampedStatus& (*const oldest)(ProcessImage&) = [](ProcessImage& s) -> StampedStatus& {
    return s.result;
  };
  expect_measured("region", live,
                  {"result", "frame_set", "trigger", "recipe", "configuration_checksum"});
  expect_measured("result", oldest, {});
  expect_regions("region", live);
  expect_regions("result", oldest);
  expect_system();
  expect_status();
  expect_cameras_and_views();
  expect_alarms();
  expect_health();
  expect_machine("machine_", live);
  expect_machine("result_machine_", oldest);
  expect_server_and_plc();
  // Only the version of the map and words for future signals are constant.
  Names constant;
  for (const std::string& name : own_.names) {
    if (!covered_.contains(name)) constant.insert(name);
  }
  Names expected{"map_version"};
  for (std::size_t word = kFirstSignals; word < kFirstSignals + 64; word += 16) {
    if (word < signals::kSignals.size()) continue;
    for (const std::string block : {"region", "result"}) {
      expected = expected + of_regions(block, {"valid_" + std::to_string(word)});
    }
  }
  EXPECT_EQ(constant, expected);
}

TEST_F(RegisterSources, MirrorsReadTheSame) {
  int mirrors = 0;
  for (const Row& row : registers().rows()) {
    if (!is_mirror(row) || !row.read) continue;
    const Table table = row.table == Table::Coil ? Table::Discrete : Table::Input;
    const Row* original = registers().find(table, row.address - kMirrorOffset);
    ASSERT_NE(original, nullptr);
    EXPECT_EQ(row.read(before_), original->read(before_)) << row.name;
    ++mirrors;
  }
  EXPECT_GT(mirrors, 1000);
}

TEST_F(RegisterSources, BitsOfWordsAreTheDiscreteInputsThereSaid) {
  struct Word {
    int discrete_input;
    std::string name;
    int bits;
  };
  ProcessImage image = before_;
  image.live.status.process_inputs = 0xa5a5'1234;
  for (std::size_t i = 0; i < signals::kMaxAlarms; i += 3) {
    image.live.status.alarms[i].alarm.state = signals::AlarmState::Unacknowledged;
  }
  for (std::size_t i = 0; i < signals::kMaxAlarms; i += 5) {
    image.live.status.alarms[i].alarm.state = signals::AlarmState::ReturnedUnacknowledged;
  }
  const auto codes = own_.contents(image);
  const auto word_named = [&](const std::string& name) {
    const auto found = std::ranges::find(own_.names, name);
    return codes.at(static_cast<std::size_t>(found - own_.names.begin()));
  };
  for (const Word& word : {Word{kStatusBits.begin, "status_bits", 32},
                           Word{kMeasurementBits.begin, "measurement_bits", 32},
                           Word{kProcessInputBits.begin, "system_process_inputs", 32},
                           Word{kActiveBits.begin, "alarms_active", 32},
                           Word{kUnacknowledgedBits.begin, "alarms_unacknowledged", 32}}) {
    for (int bit = 0; bit < word.bits; ++bit) {
      const Row* row = registers().find(Table::Discrete, word.discrete_input + bit);
      ASSERT_NE(row, nullptr);
      const std::uint32_t value = row->read ? row->read(image) : 0;
      EXPECT_EQ(value, word_named(word.name) >> bit & 1) << word.name << bit;
    }
    EXPECT_NE(word_named(word.name), 0U);
  }
}

}  // namespace
}  // namespace orbwatch::app::modbus
