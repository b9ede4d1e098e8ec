// SPDX-License-Identifier: Apache-2.0
#include "app/cli/list/list_text.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>

#include "tests/app/cli/equal_json.h"

namespace orbwatch::app::cli {
namespace {

using tests::expect_equal_json;

hal::Inventory two_cameras_and_a_chip() {
  hal::CameraEntry plain{.id = "/dev/v4l/by-id/usb-cam",
                         .back_end = "v4l2",
                         .model = "Cam 1",
                         .driver = "uvcvideo",
                         .bus = "usb-0000:00:14.0-1",
                         .paths = {"/dev/v4l/by-id/usb-cam", "/dev/video0"},
                         .problem = "",
                         .advice = "",
                         .modes = {{"yuyv", "640x480", {30, 7.5}}, {"mjpeg", "1920x1080", {}}},
                         .controls = {}};
  plain.controls = {{"gain", -5, 100, 1, 0, "", {}},
                    {"auto_exposure", 0, 3, 1, 3, "read only", {"1 = manual", "3 = aperture"}}};
  hal::CameraEntry broken;
  broken.id = "/dev/video2";
  broken.back_end = "v4l2";
  broken.problem = "cannot be opened";
  broken.advice = "160x122 has 2 lines of telemetry";
  return {{plain, broken},
          {{.path = "/dev/gpiochip1",
            .label = "gpio-sim",
            .lines = {{2, "TRIGGER_IN", false, true, "orbwatchd"}, {3, "", true, false, ""}}}}};
}

TEST(ListJson, HasEveryFieldOfEveryEntry) {
  expect_equal_json(list_json(two_cameras_and_a_chip()), R"({
    "cameras": [
      {"camera": "/dev/v4l/by-id/usb-cam", "back_end": "v4l2", "model": "Cam 1",
       "driver": "uvcvideo", "bus": "usb-0000:00:14.0-1",
       "paths": ["/dev/v4l/by-id/usb-cam", "/dev/video0"], "problem": "", "advice": "",
       "modes": [{"format": "yuyv", "size": "640x480", "frame_rates": [30, 7.5]},
                 {"format": "mjpeg", "size": "1920x1080", "frame_rates": []}],
       "controls": [{"control": "gain", "minimum": -5, "maximum": 100, "step": 1, "default": 0,
                     "state": "", "values": []},
                    {"control": "auto_exposure", "minimum": 0, "maximum": 3, "step": 1,
                     "default": 3, "state": "read only",
                     "values": ["1 = manual", "3 = aperture"]}]},
      {"camera": "/dev/video2", "back_end": "v4l2", "model": "", "driver": "", "bus": "",
       "paths": [], "problem": "cannot be opened",
       "advice": "160x122 has 2 lines of telemetry", "modes": [], "controls": []}],
    "chips": [
      {"chip": "gpio-sim", "path": "/dev/gpiochip1", "problem": "",
       "lines": [{"line": 2, "name": "TRIGGER_IN", "direction": "input", "consumer": "orbwatchd"},
                 {"line": 3, "name": "", "direction": "output", "consumer": ""}]}]})");
}

TEST(ListJson, IsValidWhateverDevicesSayOfThemselves) {
  hal::Inventory inventory;
  hal::CameraEntry camera;
  camera.id =
      "quote \" backslash \\ newline \n escape \x1b nul " + std::string(1, '\0') + " delete \x7f";
  camera.model = "gr\xc3\xbc\xc3\x9f \xe2\x82\xac \xf0\x9f\x93\xb7";  // two, three and four bytes
  // Invalid UTF-8: truncated, overlong, a surrogate, beyond Unicode, without a first byte.
  camera.driver = "\xc3|\xc0\xaf|\xed\xa0\x80|\xf5\x80\x80\x80|\x80|\xe2\x82";
  camera.modes = {{"", "", {std::nan(""), std::numeric_limits<double>::infinity(), 0.1}}};
  camera.controls = {{"wide", -0x1p63, 0.25, 0, 0, "", {}}};
  inventory.cameras.push_back(camera);
  expect_equal_json(list_json(inventory), R"({"chips": [], "cameras": [
    {"camera": "quote \" backslash \\ newline \n escape \u001b nul \u0000 delete \u007f",
     "model": "gr\u00fc\u00df \u20ac \ud83d\udcf7",
     "driver": "\ufffd|\ufffd\ufffd|\ufffd\ufffd\ufffd|\ufffd\ufffd\ufffd\ufffd|\ufffd|\ufffd",
     "back_end": "", "bus": "", "paths": [], "problem": "", "advice": "",
     "modes": [{"format": "", "size": "", "frame_rates": [null, null, 0.1]}],
     "controls": [{"control": "wide", "minimum": -9223372036854775808,
                   "maximum": 0.25, "step": 0, "default": 0, "state": "",
                   "values": []}]}]})");
}

TEST(ListJson, OfNothing) { expect_equal_json(list_json({}), R"({"cameras": [], "chips": []})"); }

TEST(ListTable, AlignsColumnsAndLeavesOutWhatIsEmpty) {
  EXPECT_EQ(list_table(two_cameras_and_a_chip()),
            R"(camera    /dev/v4l/by-id/usb-cam
back end  v4l2
model     Cam 1
driver    uvcvideo
bus       usb-0000:00:14.0-1
paths     /dev/v4l/by-id/usb-cam, /dev/video0

  format  size       frame rates
  yuyv    640x480    30, 7.5
  mjpeg   1920x1080

  control        minimum  maximum  step  default  state      values
  gain           -5       100      1     0
  auto_exposure  0        3        1     3        read only  1 = manual, 3 = aperture

camera    /dev/video2
back end  v4l2
problem   cannot be opened
advice    160x122 has 2 lines of telemetry

chip  gpio-sim
path  /dev/gpiochip1

  line  name        direction  consumer
  2     TRIGGER_IN  input      orbwatchd
  3                 output

)");
}

TEST(ListTable, OfNothingAndOfTextsThatATerminalWouldObey) {
  EXPECT_EQ(list_table({}), "no cameras\nno chips\n");
  hal::Inventory inventory;
  inventory.cameras.emplace_back().id = "\x1b[2Jcam\n";
  EXPECT_EQ(list_table(inventory), "camera  ?[2Jcam?\n\nno chips\n");
}

std::vector<Fleet::Entry> two_appliances(hal::TimePoint now) {
  Fleet::Entry cell{"01", {}, now, now, false, false, 0};
  cell.notice.name = "cell 3";
  cell.notice.version = "1.2.3";
  cell.notice.prefix = "orbwatch";
  cell.notice.page = {"10.0.0.7", 443};
  cell.notice.state = SystemState::Running;
  cell.notice.condition = {Severity::None, "running: every camera delivers"};
  cell.notice.alarms = 2;
  cell.notice.alarm = {Severity::Alarm, "1, pool: hot_spot_width: high alarm"};
  Fleet::Entry gone{"02", {}, now, now - std::chrono::seconds(9), true, false, 4};
  gone.notice.name = "cell 4";
  return {cell, gone};
}

TEST(AppliancesJson, HasEveryFieldOfEveryAppliance) {
  const auto now = hal::Clock::now();
  const auto json = nlohmann::json::parse(appliances_json(two_appliances(now), now));
  ASSERT_EQ(json["appliances"].size(), 2U);
  auto cell = json["appliances"][0];
  EXPECT_TRUE(cell["newest"].is_string());
  cell.erase("newest");
  expect_equal_json(cell.dump(), R"({
    "id": "01", "name": "cell 3", "is_self": false, "is_gone": false, "age": 0, "state": 1,
    "state_text": "running: every camera delivers",
    "condition": "running: every camera delivers", "severity": 0, "alarms": 2,
    "alarm": "1, pool: hot_spot_width: high alarm", "alarm_severity": 2, "version": "1.2.3",
    "prefix": "orbwatch", "page": "https://10.0.0.7:443/", "pictures": 0
  })");
  EXPECT_EQ(json["appliances"][1]["is_gone"], true);
  EXPECT_EQ(json["appliances"][1]["age"], 9);
  EXPECT_TRUE(json["appliances"][1]["page"].is_null());
}

TEST(AppliancesTable, SaysWhoIsGone) {
  const std::string table = appliances_table(two_appliances(hal::Clock::now()));
  EXPECT_EQ(table,
            "  name    state    alarms  alarm                                page"
            "                   version  prefix\n"
            "  cell 3  running  2       1, pool: hot_spot_width: high alarm  https://10.0.0.7:443/"
            "  1.2.3    orbwatch\n"
            "  cell 4  gone     0       -                                    -\n");
}

}  // namespace
}  // namespace orbwatch::app::cli
