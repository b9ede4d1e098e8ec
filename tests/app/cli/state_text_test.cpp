#include "app/cli/state_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <sstream>

#include "tests/app/cli/equal_json.h"

namespace orbwatch::app {
namespace {

constexpr double kNotValid = signals::kNotValid;

std::size_t index_of(std::string_view signal) {
  std::size_t index = 0;
  while (signals::kSignals[index].name != signal) ++index;
  return index;
}

AlarmStatus wide_bead() {
  AlarmStatus alarm;
  alarm.alarm = {signals::AlarmState::Unacknowledged, signals::AlarmLevel::HighWarning,
                 signals::AlarmLevel::HighAlarm, false};
  alarm.region = 1;
  alarm.signal = index_of("hot_spot_width");
  alarm.value = 3.25;
  return alarm;
}

/// Two regions of which one measures, an alarm, a camera and a view.
ReceivedState welding() {
  ReceivedState state;
  StatusReport& report = state.report;
  report.names = {{"thermal"}, {"front"}, {{7, {"weld", "edge"}}}};
  Status& status = report.status;
  status.state = SystemState::Running;
  status.heartbeat = 12;
  status.frame_set = 34;
  status.recipe = 7;
  status.process_active = true;
  status.skew_ms = 0.25;
  status.load = 0.5;
  status.region_count = 2;
  status.regions[1].quality = Quality::Apparent;
  status.regions[1].signals.hot_spot_width = 3.25;
  status.regions[1].signals.hot_spot_pixels = 1234;
  status.alarm_count = 1;
  status.alarms[0] = wide_bead();
  report.times.alarm_age_s[0] = 1.5;
  status.camera_count = 1;
  status.cameras[0].frames = 99;
  status.cameras[0].frames_per_second = 25;
  report.times.last_frame_age_s[0] = 0.0625;
  status.view_count = 1;
  status.views[0] = {90, 1, 12.5, 20, 30, 2};
  status.health.board_temperature = 48.5;
  report.times.stamp =
      std::chrono::system_clock::time_point(std::chrono::nanoseconds(1'700'000'000'012'345'678));
  state.commands = {1, 2, 3, 4};
  return state;
}

std::string json_number(double value) {
  if (!signals::is_valid(value)) return "null";
  std::ostringstream text;
  text << value;
  return text.str();
}

/// All of a list, by name.
template <class Values, class Infos>
std::string json_values(const Values& values, const Infos& infos) {
  std::string text;
  for (const auto& info : infos) {
    text += (text.empty() ? "{\"" : ", \"") + std::string(info.name) +
            "\": " + json_number(values.*info.member);
  }
  return text + "}";
}

TEST(StateJson, HasEveryFieldOnOneLine) {
  const ReceivedState state = welding();
  const auto& regions = state.report.status.regions;
  const std::string text = state_json(state);
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  orbwatch::tests::expect_equal_json(text, R"({
    "stamp": "2023-11-14T22:13:20.012345678Z",
    "system_state": 1, "system_state_text": "running", "heartbeat": 12, "frame_set": 34,
    "trigger": 0, "result": 0, "recipe": 7, "configuration_checksum": 0, "recipe_refused": false,
    "process_active": true, "process_inputs": 0, "selected_view": 0, "overruns": 0,
    "unmatched": 0, "skew_ms": 0.25, "load": 0.5,
    "regions": [
      {"region": "weld", "quality": 0, "quality_text": "not measured", "signals": )" +
                                               json_values(regions[0].signals, signals::kSignals) +
                                               R"(},
      {"region": "edge", "quality": 2, "quality_text": "good, temperatures are apparent",
       "signals": )" + json_values(regions[1].signals, signals::kSignals) +
                                               R"(}],
    "alarms": [
      {"alarm": 1, "region": "edge", "signal": "hot_spot_width",
       "state": 1, "state_text": "in alarm, not acknowledged", "level": 3,
       "level_text": "high warning", "announced": 4, "announced_text": "high alarm",
       "measurement_lost": false, "value": 3.25, "age_s": 1.5}],
    "cameras": [
      {"camera": "thermal", "fault": 0, "fault_text": "camera delivers", "frames_per_second": 25,
       "latency_p50_ms": 0, "latency_p99_ms": 0, "last_frame_age_s": 0.0625, "frames": 99,
       "lost": 0, "dropped": 0, "unmatched": 0, "triggers": 0, "missed": 0}],
    "views": [
      {"view": "front", "frames_per_second": 12.5, "latency_p50_ms": 20, "latency_p99_ms": 30,
       "published": 90, "skipped": 1, "superseded": 2}],
    "health": )" + json_values(state.report.status.health, kHealthFigures) +
                                               R"(,
    "commands": {"done": 1, "refused": 2, "repeated": 3, "dropped": 4}})");
}

TEST(StateJson, IsValidWhateverTheSenderSays) {
  ReceivedState state = welding();
  state.report.names = {{"quote \" escape \x1b"}, {"\xff"}, {{7, {"a\nb"}}}};
  state.report.times.stamp = {};
  state.report.status.regions[0].signals.hot_spot_yaw = std::numeric_limits<double>::infinity();
  state.report.status.heartbeat = std::numeric_limits<std::uint64_t>::max();
  const std::string text = state_json(state);
  orbwatch::tests::expect_equal_json(text, text);
  EXPECT_THAT(text, testing::HasSubstr("\"stamp\": null"));
  EXPECT_THAT(text, testing::HasSubstr("\"hot_spot_yaw\": null"));
  EXPECT_THAT(text, testing::HasSubstr("\"heartbeat\": 18446744073709551615"));
}

TEST(StateTable, ShowsWhatIsMeasuredWithUnits) {
  EXPECT_EQ(state_table(welding()), R"(stamp                   2023-11-14T22:13:20.012345678Z
system state            running
heartbeat               12
frame set               34
trigger                 0
result                  0
recipe                  7
configuration checksum  0
recipe refused          no
process active          yes
process inputs          0
selected view           0
overruns                0
unmatched               0
skew ms                 0.25
load                    0.5

  region  quality
  weld    not measured
  edge    good, temperatures are apparent

  signals          weld  edge
  hot spot pixels  -     1234 px
  hot spot width   -     3.25 mm

  alarm  region  signal          state                       level         announced   measurement lost  value    age s
  1      edge    hot_spot_width  in alarm, not acknowledged  high warning  high alarm  no                3.25 mm  1.5

  camera   fault            frames per second  latency p50 ms  latency p99 ms  last frame age s  frames  lost  dropped  unmatched  triggers  missed
  thermal  camera delivers  25                 0               0               0.0625            99      0     0        0          0         0

  view   frames per second  latency p50 ms  latency p99 ms  published  skipped  superseded
  front  12.5               20              30              90         1        2

  health
  board temperature  48.5 degC

  commands
  done      1
  refused   2
  repeated  3
  dropped   4
)");
}

TEST(StateTable, OfNothingAndOfTextsThatATerminalWouldObey) {
  ReceivedState state;
  state.report.status.camera_count = 1;
  state.report.names.cameras = {"\x1b[2Jcam\n"};
  state.report.times.last_frame_age_s[0] = kNotValid;
  const std::string text = state_table(state);
  EXPECT_THAT(text, testing::HasSubstr("stamp                   -\n"));
  EXPECT_THAT(text, testing::HasSubstr("  ?[2Jcam?  camera delivers"));
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace orbwatch::app
