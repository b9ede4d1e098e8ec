#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "app/modbus/bits.h"
#include "app/modbus/register_map.h"

/// Every register follows what it reports, and nothing else.
namespace orbwatch::app::modbus {
namespace {

using std::chrono::milliseconds;
using Names = std::set<std::string>;

const RegisterMap& registers() {
  static const RegisterMap map;
  return map;
}

/// The registers of their own (no mirrors), and what to call them: bits are told from words of the
/// same name by a "?".
struct Registers {
  std::vector<std::string> names;
  std::vector<const Row*> rows;

  Registers() {
    std::set<std::string> known;
    for (const Row& row : registers().rows()) {
      if (row.address >= kMirrorOffset || !row.read) continue;
      rows.push_back(&row);
      names.push_back(row.name + (row.table == Table::Discrete ? "?" : ""));
      EXPECT_TRUE(known.insert(names.back()).second) << names.back();
    }
  }

  std::vector<std::uint32_t> contents(const Snapshot& snapshot) const {
    std::vector<std::uint32_t> codes;
    codes.reserve(rows.size());
    for (const Row* row : rows) codes.push_back(row->read(snapshot));
    return codes;
  }
};

void measure_something(Moment& moment, double share) {
  moment.utc = std::chrono::microseconds(1'700'000'000'000'100);
  Status& status = moment.status;
  status.result = 3;
  status.frame_set = 30;
  status.trigger = 4;
  status.recipe = 2;
  status.configuration_checksum = 77;
  status.process_active = true;
  status.region_count = signals::kMaxRegions;
  for (RegionStatus& region : status.regions) {
    region.quality = Quality::Good;
    for (const auto& signal : signals::kSignals) {
      region.signals.*signal.member = signal.minimum + share * (signal.maximum - signal.minimum);
    }
    region.signals.hot_spot_present = 1;
  }
}

/// Everything is there and works.
Snapshot full_snapshot() {
  Snapshot snapshot;
  snapshot.now = hal::TimePoint{} + std::chrono::hours(100);
  snapshot.start = snapshot.now - std::chrono::hours(9);
  measure_something(snapshot.live, 0.5);
  measure_something(snapshot.results.oldest, 0.25);
  snapshot.results.count = 2;
  snapshot.plc.age = milliseconds(20);
  Status& status = snapshot.live.status;
  status.state = SystemState::Running;
  status.stamp = snapshot.now - milliseconds(50);
  status.camera_count = kMaxCameras;
  status.view_count = kMaxViews;
  status.alarm_count = signals::kMaxAlarms;
  for (CameraStatus& camera : status.cameras) camera.last_frame = snapshot.now - milliseconds(40);
  for (AlarmStatus& alarm : status.alarms) {
    alarm.value = 0;
    alarm.since = snapshot.now - milliseconds(5000);
  }
  for (const HealthInfo& figure : kHealthFigures) {
    status.health.*figure.member = (figure.minimum + figure.maximum) / 2;
  }
  status.health.throttling = 0;
  status.health.clock_synchronised = 1;
  return snapshot;
}

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

class RegisterSources : public testing::Test {
 protected:
  /// This change of the snapshot changes these registers and no others.
  void expect(const std::function<void(Snapshot&)>& change, const Names& names) {
    Snapshot after = before_;
    change(after);
    const auto codes = own_.contents(after);
    Names changed;
    for (std::size_t i = 0; i < codes.size(); ++i) {
      if (codes[i] != codes_before_[i]) changed.insert(own_.names[i]);
    }
    EXPECT_EQ(changed, names);
    covered_ = covered_ + names;
  }

  /// What is measured in all regions of `moment`, whose rows are called block_n_...
  void expect_measured(const std::string& block, Moment& (*moment)(Snapshot&),
                       const Names& also_live);
  void expect_regions(const std::string& block, Moment& (*moment)(Snapshot&));
  void expect_system();
  void expect_status();
  void expect_cameras_and_views();
  void expect_alarms();
  void expect_health();
  void expect_server_and_plc();

  const Registers own_;
  const Snapshot before_ = full_snapshot();
  const std::vector<std::uint32_t> codes_before_ = own_.contents(before_);
  Names covered_;
};

void RegisterSources::expect_measured(const std::string& block, Moment& (*moment)(Snapshot&),
                                      const Names& also_live) {
  const auto of = [&](const std::string& name) {
    return of_regions(block, {name}) + (also_live.contains(name) ? Names{name} : Names{});
  };
  expect([&](Snapshot& s) { ++moment(s).status.result; }, of("result"));
  expect([&](Snapshot& s) { ++moment(s).status.frame_set; }, of("frame_set"));
  expect([&](Snapshot& s) { ++moment(s).status.trigger; }, of("trigger"));
  expect([&](Snapshot& s) { ++moment(s).status.recipe; }, of("recipe"));
  expect([&](Snapshot& s) { ++moment(s).status.configuration_checksum; },
         of("configuration_checksum"));
  const bool live = !also_live.empty();
  expect([&](Snapshot& s) { moment(s).utc += std::chrono::microseconds(3'000'001); },
         of_regions(block, {"utc_seconds", "utc_microseconds"}) +
             (live ? Names{"frame_set_utc_seconds", "frame_set_utc_microseconds"} : Names{}));
  expect([&](Snapshot& s) { moment(s).status.process_active = false; },
         of_regions(block, {"process_active"}) +
             (live ? Names{"process_active?", "status_word"} : Names{}));
}

void RegisterSources::expect_regions(const std::string& block, Moment& (*moment)(Snapshot&)) {
  const bool live = block == "region";
  for (std::size_t i = 0; i < signals::kMaxRegions; ++i) {
    const auto name = [&](std::string_view what) { return numbered(block, i, std::string(what)); };
    const auto region = [&](Snapshot& s) -> RegionStatus& { return moment(s).status.regions[i]; };
    expect([&](Snapshot& s) { region(s).quality = Quality::Apparent; }, {name("quality")});
    expect(
        [&](Snapshot& s) { region(s).quality = Quality::NotMeasured; },
        Names{name("quality")} + (live ? Names{name("measured?"), "measurement_word"} : Names{}));
    for (std::size_t n = 0; n < signals::kSignals.size(); ++n) {
      const signals::SignalInfo& signal = signals::kSignals[n];
      const Names hot_spot = live && signal.member == &signals::Signals::hot_spot_present
                                 ? Names{name("hot_spot?"), "measurement_word"}
                                 : Names{};
      expect([&](Snapshot& s) { region(s).signals.*signal.member = signal.minimum; },
             Names{name(signal.name)} + hot_spot);
      expect([&](Snapshot& s) { region(s).signals.*signal.member = signals::kNotValid; },
             Names{name(signal.name), name("valid_" + std::to_string(n / 16 * 16))} + hot_spot);
    }
    // An alarm that stands in this region.
    AlarmStatus alarm{.alarm = {signals::AlarmState::Acknowledged, signals::AlarmLevel::LowWarning,
                                signals::AlarmLevel::LowWarning, false},
                      .region = i};
    if (live) continue;  // with the alarms
    expect(
        [&](Snapshot& s) {
          moment(s).status.alarms[9] = alarm;
          moment(s).status.alarm_count = 10;
        },
        {name("alarm_severity")});
  }
}

void RegisterSources::expect_system() {
  const auto to_state = [this](SystemState state, const Names& names) {
    expect([state](Snapshot& s) { s.live.status.state = state; },
           Names{"system_state", "status_word", "running?"} + names);
  };
  to_state(SystemState::Starting, {});
  to_state(SystemState::Degraded, {"degraded?"});
  to_state(SystemState::Fault, {"fault?", "fault_word"});
  to_state(SystemState::Stopped, {"stopped?"});
  Names deliver;
  for (std::size_t i = 0; i < kMaxCameras; ++i) deliver.insert(numbered("camera", i, "delivers?"));
  expect([](Snapshot& s) { s.stale = true; },
         deliver + Names{"stale?", "status_word", "fault_word", "measurement_word"});
  Names ages{"frame_set_age", "uptime"};
  for (std::size_t i = 0; i < kMaxCameras; ++i)
    ages.insert(numbered("camera", i, "last_frame_age"));
  for (std::size_t i = 1; i <= signals::kMaxAlarms; ++i) ages.insert(numbered("alarm", i, "age"));
  expect([](Snapshot& s) { s.now += std::chrono::seconds(2); }, ages);
  expect([](Snapshot& s) { s.start -= std::chrono::seconds(2); }, {"uptime"});
}

void RegisterSources::expect_status() {
  using S = Snapshot&;
  expect([](S s) { ++s.live.status.heartbeat; }, {"heartbeat"});
  expect([](S s) { s.live.status.stamp -= milliseconds(7); }, {"frame_set_age"});
  expect([](S s) { ++s.live.status.overruns; }, {"overruns"});
  expect([](S s) { ++s.live.status.unmatched; }, {"unmatched"});
  expect([](S s) { s.live.status.skew_ms = 1.2; }, {"skew"});
  expect([](S s) { s.live.status.load = 0.5; }, {"load"});
  expect([](S s) { s.live.status.load = 1.5; }, {"load", "fault_word"});
  expect([](S s) { ++s.live.status.selected_view; }, {"selected_view"});
  for (std::size_t i = 0; i < 32; ++i) {
    expect([i](S s) { s.live.status.process_inputs = 1U << i; },
           {"process_inputs", "process_input_" + std::to_string(i) + "?"});
  }
  expect([](S s) { --s.live.status.view_count; }, {"view_count"});
  expect([](S s) { --s.live.status.region_count; }, {"region_count"});
  const std::string last = numbered("camera", kMaxCameras - 1, "");
  expect([](S s) { --s.live.status.camera_count; },
         {"camera_count", last + "fault", last + "delivers?", "measurement_word"});
  expect([](S s) { --s.live.status.alarm_count; },
         {"alarm_count", numbered("alarm", signals::kMaxAlarms, "state")});
}

void RegisterSources::expect_cameras_and_views() {
  for (std::size_t i = 0; i < kMaxCameras; ++i) {
    const auto expect_of = [&](const std::string& what, auto change, const Names& also = {}) {
      expect([&](Snapshot& s) { change(s.live.status.cameras[i]); },
             Names{numbered("camera", i, what)} + also);
    };
    using C = CameraStatus&;
    expect_of("fault", [](C c) { c.fault = hal::Fault::Stalled; },
              {numbered("camera", i, "delivers?"), "measurement_word", "fault_word"});
    expect_of("frames_per_second", [](C c) { c.frames_per_second = 20; });
    expect_of("latency_p50", [](C c) { c.latency_p50_ms = 1; });
    expect_of("latency_p99", [](C c) { c.latency_p99_ms = 1; });
    expect_of("last_frame_age", [](C c) { c.last_frame -= milliseconds(9); });
    expect_of("last_frame_age", [](C c) { c.last_frame = {}; });
    expect_of("frames", [](C c) { ++c.frames; });
    expect_of("lost", [](C c) { ++c.lost; });
    expect_of("dropped", [](C c) { ++c.dropped; });
    expect_of("unmatched", [](C c) { ++c.unmatched; });
    expect_of("triggers", [](C c) { ++c.triggers; });
    expect_of("missed", [](C c) { ++c.missed; });
  }
  for (std::size_t i = 0; i < kMaxViews; ++i) {
    const auto expect_of = [&](const std::string& what, auto change) {
      expect([&](Snapshot& s) { change(s.live.status.views[i]); }, {numbered("view", i, what)});
    };
    using V = ViewStatus&;
    expect_of("published", [](V v) { ++v.published; });
    expect_of("skipped", [](V v) { ++v.skipped; });
    expect_of("superseded", [](V v) { ++v.superseded; });
    expect_of("frames_per_second", [](V v) { v.frames_per_second = 20; });
    expect_of("latency_p50", [](V v) { v.latency_p50_ms = 1; });
    expect_of("latency_p99", [](V v) { v.latency_p99_ms = 1; });
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
          [&](Snapshot& s) {
            s.live.status.alarms[i].alarm = {state, level, announced, false};
            s.live.status.alarms[i].region = region;
          },
          [&] {
            Names all = names;
            if (region == 0) all.erase(name("region"));
            return all;
          }());
    };
    const std::string severity = numbered("region", region, "alarm_severity");
    const Names severe{"alarm_severity", severity, "status_word"};
    const Names asks{name("unacknowledged?"), "alarms_unacknowledged", "unacknowledged?"};
    expect_in(AlarmState::Unacknowledged, AlarmLevel::HighAlarm, AlarmLevel::HighAlarm,
              stands + severe + asks + Names{name("level"), "alarm?", "alarms_severe"});
    expect_in(AlarmState::Acknowledged, AlarmLevel::LowWarning, AlarmLevel::LowWarning,
              stands + severe + Names{name("level"), "warning?"});
    // Latched at what it was, although its signal has returned.
    expect_in(AlarmState::LatchedUnacknowledged, AlarmLevel::None, AlarmLevel::LowAlarm,
              stands + severe + asks + Names{"alarm?", "alarms_severe"});
    expect_in(AlarmState::ReturnedUnacknowledged, AlarmLevel::None, AlarmLevel::LowAlarm,
              asks + Names{name("state"), name("region"), "status_word"});
    expect_in(AlarmState::SuppressedByDesign, AlarmLevel::None, AlarmLevel::None,
              {name("state"), name("region")});
    const auto expect_of = [&](const std::string& what, auto change) {
      expect([&](Snapshot& s) { change(s.live.status.alarms[i]); }, {what});
    };
    expect_of(name("region"), [](AlarmStatus& a) { ++a.region; });
    expect_of(name("signal"), [](AlarmStatus& a) { ++a.signal; });
    expect_of(name("value"), [](AlarmStatus& a) { a.value = 1; });
    expect_of(name("value"), [](AlarmStatus& a) { a.value = signals::kNotValid; });
    expect_of(name("age"), [](AlarmStatus& a) { a.since -= milliseconds(3); });
    expect_of("alarms_not_measured", [](AlarmStatus& a) { a.alarm.measurement_lost = true; });
  }
}

void RegisterSources::expect_health() {
  for (const HealthInfo& figure : kHealthFigures) {
    Names names{std::string(figure.name)};
    if (figure.member == &Health::throttling) names.insert("fault_word");
    if (figure.member == &Health::clock_synchronised) {
      names = names + Names{"clock_synchronised?", "status_word", "fault_word"};
    }
    const double other =
        before_.live.status.health.*figure.member == figure.minimum ? 1 : figure.minimum;
    expect([&](Snapshot& s) { s.live.status.health.*figure.member = other; }, names);
  }
  expect([](Snapshot& s) { s.live.status.health.throttling = 0x10; }, {"throttling"});
  expect([](Snapshot& s) { s.live.status.health.clock_synchronised = signals::kNotValid; },
         {"clock_synchronised", "clock_synchronised?", "status_word"});
}

void RegisterSources::expect_server_and_plc() {
  using S = Snapshot&;
  expect([](S s) { s.live.status.recipe_refused = true; }, {"recipe_refused?", "status_word"});
  expect([](S s) { ++s.results.count; }, {"result_count"});
  expect([](S s) { s.results.count = 0; }, {"result_count", "result_available?", "status_word"});
  expect([](S s) { ++s.results.refused; }, {"result_overruns"});
  expect([](S s) { s.results.any_refused = true; },
         {"result_overrun?", "status_word", "fault_word"});
  expect([](S s) { ++s.results.last_taken; }, {"result_taken"});
  expect([](S s) { ++s.server.answered; }, {"modbus_answered"});
  expect([](S s) { ++s.server.refused; }, {"modbus_refused"});
  expect([](S s) { ++s.server.dropped; }, {"modbus_dropped"});
  expect([](S s) { ++s.server.connections; }, {"modbus_connections"});
  expect([](S s) { ++s.server.broken; }, {"serial_broken"});
  expect([](S s) { ++s.server.for_others; }, {"serial_for_others"});
  expect([](S s) { s.plc.age += milliseconds(1); }, {"plc_heartbeat_age"});
  expect([](S s) { s.plc.is_alive = true; }, {"plc_alive?", "status_word"});
  expect([](S s) { s.plc.is_silent = true; }, {"fault_word"});
  expect([](S s) { ++s.plc.heartbeat; }, {"plc_heartbeat"});
  for (std::size_t i = 0; i < kMaxArguments; ++i) {
    expect([i](S s) { --s.plc.command.arguments[i]; }, {"argument_" + std::to_string(i)});
  }
  expect([](S s) { ++s.plc.command.command; }, {"command"});
  expect([](S s) { ++s.plc.command.sequence; }, {"command_sequence"});
  expect([](S s) { ++s.plc.command.acknowledged; }, {"acknowledged_sequence"});
  expect([](S s) { s.plc.command.result = CommandResult::Busy; }, {"command_result"});
  expect([](S s) { ++s.plc.command.last_command; }, {"last_command"});
}

TEST_F(RegisterSources, EveryRegisterFollowsItsSourceAndNoOther) {
  Moment& (*const live)(Snapshot&) = [](Snapshot& s) -> Moment& { return s.live; };
  Moment& (*const oldest)(Snapshot&) = [](Snapshot& s) -> Moment& { return s.results.oldest; };
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
  expect_server_and_plc();
  // No register is constant, but the one that says what this map is.
  Names constant;
  for (const std::string& name : own_.names) {
    if (!covered_.contains(name)) constant.insert(name);
  }
  EXPECT_EQ(constant, Names{"map_version"});
}

TEST_F(RegisterSources, MirrorsReadTheSame) {
  int mirrors = 0;
  for (const Row& row : registers().rows()) {
    if (row.address < kMirrorOffset || !row.read) continue;
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
  Snapshot snapshot = before_;
  snapshot.live.status.process_inputs = 0xa5a5'1234;
  for (std::size_t i = 0; i < signals::kMaxAlarms; i += 3) {
    snapshot.live.status.alarms[i].alarm.state = signals::AlarmState::Unacknowledged;
  }
  for (std::size_t i = 0; i < signals::kMaxAlarms; i += 5) {
    snapshot.live.status.alarms[i].alarm.state = signals::AlarmState::ReturnedUnacknowledged;
  }
  const auto codes = own_.contents(snapshot);
  const auto word_named = [&](const std::string& name) {
    const auto found = std::ranges::find(own_.names, name);
    return codes.at(static_cast<std::size_t>(found - own_.names.begin()));
  };
  for (const Word& word :
       {Word{kStatusBits, "status_word", 16}, Word{kMeasurementBits, "measurement_word", 16},
        Word{kProcessInputBits, "process_inputs", 32}, Word{kActiveBits, "alarms_active", 32},
        Word{kUnacknowledgedBits, "alarms_unacknowledged", 32}}) {
    for (int bit = 0; bit < word.bits; ++bit) {
      const Row* row = registers().find(Table::Discrete, word.discrete_input + bit);
      ASSERT_NE(row, nullptr);
      const std::uint32_t value = row->read ? row->read(snapshot) : 0;
      EXPECT_EQ(value, word_named(word.name) >> bit & 1) << word.name << bit;
    }
    EXPECT_NE(word_named(word.name), 0U);
  }
}

}  // namespace
}  // namespace orbwatch::app::modbus
