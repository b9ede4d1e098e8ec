// SPDX-License-Identifier: Apache-2.0
#include "app/cli/state_text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/app/cli/equal_json.h"

namespace orbwatch::app::cli {
namespace {

constexpr double kNotValid = signals::kNotValid;

/// State with two regions of which one measures, an alarm, a camera and a view.
ReceivedState welding() {
  ReceivedState state;
  state.stamp =
      std::chrono::system_clock::time_point(std::chrono::nanoseconds(1'700'000'000'012'345'678));
  state.frame_set = 34;
  state.recipe = 7;
  state.system_state = SystemState::Running;
  state.heartbeat = 12;
  state.components = {
      {{"system"},
       {{"state", 1, "", "running: every camera delivers"},
        {"heartbeat", 12},
        {"recipe_refused", 0, "", "false"},
        {"process_active", 1, "", "true"},
        {"skew_ms", 0.25, "ms"},
        {"load", 0.5}}},
      {{"region", "weld"},
       {{"quality", 0, "", "not measured"},
        {"hot_spot_pixels", kNotValid, "px"},
        {"hot_spot_width", kNotValid, "mm"},
        {"hot_spot_yaw", kNotValid, "deg"}}},
      {{"region", "edge"},
       {{"quality", 2, "", "good, temperatures are apparent"},
        {"hot_spot_pixels", 1234, "px"},
        {"hot_spot_width", 3.25, "mm"},
        {"hot_spot_yaw", kNotValid, "deg"}}},
      {{"alarm", "1, edge: hot_spot_width"},
       {{"state", 1, "", "in alarm, not acknowledged"}, {"value", 3.25, "mm"}}},
      {{"alarm", "2, weld: hot_spot_yaw"},
       {{"state", 0, "", "normal"}, {"value", kNotValid, "deg"}}},
      {{"alarm", "3, weld: hot_spot_width"},
       {{"state", 0, "", "normal"}, {"value", kNotValid, "mm"}}},
      {{"alarm", "4, edge: hot_spot_pixels"}, {{"state", 0, "", "normal"}, {"value", 1234, "px"}}},
      {{"camera", "thermal"},
       {{"fault", 0, "", "camera delivers"},
        {"frames_per_second", 25, "1/s"},
        {"last_frame_age", 0.0625, "s"},
        {"frames", 1234567}}},
      {{"health"}, {{"board_temperature", 48.5, "degC"}, {"throttling", kNotValid}}},
      {{"commands"}, {{"done", 1}, {"dropped", 4}}},
  };
  return state;
}

TEST(StateJson, HasEveryFieldOnOneLine) {
  const std::string text = state_json(welding());
  EXPECT_EQ(text.find('\n'), text.size() - 1);
  orbwatch::tests::expect_equal_json(text, R"({
    "stamp": "2023-11-14T22:13:20.012345678Z", "frame_set": 34, "trigger": 0, "result": 0,
    "recipe": 7, "configuration_checksum": 0, "system_state": 1, "heartbeat": 12,
    "system": {"state": 1, "state_text": "running: every camera delivers", "heartbeat": 12,
               "recipe_refused": false, "process_active": true, "skew_ms": 0.25, "load": 0.5},
    "regions": [
      {"name": "weld", "quality": 0, "quality_text": "not measured", "hot_spot_pixels": null,
       "hot_spot_width": null, "hot_spot_yaw": null},
      {"name": "edge", "quality": 2, "quality_text": "good, temperatures are apparent",
       "hot_spot_pixels": 1234, "hot_spot_width": 3.25, "hot_spot_yaw": null}],
    "alarms": [
      {"name": "1, edge: hot_spot_width", "state": 1, "state_text": "in alarm, not acknowledged",
       "value": 3.25},
      {"name": "2, weld: hot_spot_yaw", "state": 0, "state_text": "normal", "value": null},
      {"name": "3, weld: hot_spot_width", "state": 0, "state_text": "normal", "value": null},
      {"name": "4, edge: hot_spot_pixels", "state": 0, "state_text": "normal", "value": 1234}],
    "cameras": [
      {"name": "thermal", "fault": 0, "fault_text": "camera delivers", "frames_per_second": 25,
       "last_frame_age": 0.0625, "frames": 1234567}],
    "health": {"board_temperature": 48.5, "throttling": null},
    "commands": {"done": 1, "dropped": 4}})");
}

TEST(StateJson, IsValidWhateverTheSenderSays) {
  ReceivedState state = welding();
  state.stamp = {};
  state.heartbeat = std::numeric_limits<std::uint64_t>::max();
  state.components = {
      {{"camera", "quote \" escape \x1b"}, {{"yaw", std::numeric_limits<double>::infinity()}}},
      {{"view", "\xff"}, {{"name", 1, "", "\xc3"}}},
      {{"region", "a\nb"}, {}},
      // Kinds whose members of the document collide, and names of its own members.
      {{"views"}, {{"frames", 1}}},
      {{"view", "second"}, {}},
      {{"regions", "third"}, {}},
      {{"region"}, {}},
      {{"stamp", ""}, {}},
  };
  const std::string text = state_json(state);
  orbwatch::tests::expect_equal_json(text, text);
  EXPECT_THAT(text, testing::HasSubstr("\"yaw\":null"));
  EXPECT_THAT(text, testing::HasSubstr("\"heartbeat\":18446744073709551615"));
  state.components.clear();
  EXPECT_THAT(state_json(state), testing::HasSubstr("\"stamp\":null"));
}

TEST(StateTable, ShowsWhatIsMeasuredWithUnits) {
  EXPECT_EQ(state_table(welding()), R"(stamp  2023-11-14T22:13:20.012345678Z

  system
  state           running: every camera delivers
  heartbeat       12
  recipe refused  no
  process active  yes
  skew ms         0.25 ms
  load            0.5

  region           weld          edge
  quality          not measured  good, temperatures are apparent
  hot spot pixels  -             1234 px
  hot spot width   -             3.25 mm

  alarm                     state                       value
  1, edge: hot_spot_width   in alarm, not acknowledged  3.25 mm
  2, weld: hot_spot_yaw     normal                      -
  3, weld: hot_spot_width   normal                      -
  4, edge: hot_spot_pixels  normal                      1234 px

  camera             thermal
  fault              camera delivers
  frames per second  25 1/s
  last frame age     0.0625 s
  frames             1234567

  health
  board temperature  48.5 degC

  commands
  done      1
  dropped   4
)");
}

TEST(StateTable, OfNothingAndOfTextsThatATerminalWouldObey) {
  EXPECT_EQ(state_table({}), "stamp  -\n");
  ReceivedState state;
  state.components = {{{"camera", "\x1b[2Jcam\n"}, {{"fault", 0, "", "camera\tdelivers"}}},
                      {{"camera", "other"}, {{"frames", 1, "\x1b[1m"}}}};
  const std::string text = state_table(state);
  EXPECT_THAT(text, testing::HasSubstr("  camera  ?[2Jcam?         other\n"));
  EXPECT_THAT(text, testing::HasSubstr("  fault   camera?delivers  -\n"));
  EXPECT_THAT(text, testing::HasSubstr("  frames  -                1 ?[1m\n"));
  EXPECT_EQ(text.find('\x1b'), std::string::npos);
}

}  // namespace
}  // namespace orbwatch::app::cli
