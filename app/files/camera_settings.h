// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "app/model/alignment/watch_settings.h"
#include "app/pipeline/views/view_settings.h"
#include "app/ports/lines/line_settings.h"
#include "app/simulation/simulated_camera_settings.h"
#include "hal/back_end.h"
#include "hal/camera.h"
#include "hal/fault.h"
#include "hal/genicam/genicam_settings.h"
#include "hal/libcamera/libcamera_settings.h"
#include "hal/lines/frame_trigger.h"
#include "hal/module/module_list.h"
#include "hal/replay/replay_settings.h"
#include "hal/sync/frame_matcher.h"
#include "hal/test_pattern/test_pattern_settings.h"
#include "hal/v4l2/v4l2_settings.h"
#include "proc/settings/settings.h"
#include "proc/signals/radiometry.h"

namespace orbwatch::app::files {

/// The list of camera back-ends: one line each. A settings struct has its word in the file as
/// kName, its keys in visit() and what programs need to know in kFacts, see hal/back_end.h;
/// make_camera() beside it makes the camera. Only the settings are needed to read a file.
using BackEndSettings = std::variant<simulation::SimulatedCameraSettings,  //
                                     hal::ReplaySettings,                  //
                                     hal::V4l2Settings,                    //
                                     hal::LibcameraSettings,               //
                                     hal::GenicamSettings,                 //
                                     hal::TestPatternSettings>;

inline const hal::BackEndFacts& facts_of(const BackEndSettings& back_end) {
  return std::visit(
      []<class Settings>(const Settings&) -> const hal::BackEndFacts& { return Settings::kFacts; },
      back_end);
}

/// Empty: the back-end's cameras have none.
inline std::string address_of(const BackEndSettings& back_end) {
  return std::visit(
      []<class Settings>(const Settings& settings) -> std::string {
        if constexpr (Settings::kFacts.address_key.empty())
          return "";
        else
          return settings.address();
      },
      back_end);
}

/// Calls function(std::type_identity<SETTINGS>()) for each back-end, in the order of the list.
template <class Function>
constexpr void for_each_back_end(Function&& function) {
  const auto call = [&]<class... Settings>(std::type_identity<std::variant<Settings...>>) {
    (function(std::type_identity<Settings>()), ...);
  };
  call(std::type_identity<BackEndSettings>());
}

static_assert([] {
  bool are_listed = true;
  for_each_back_end([&]<class Settings>(std::type_identity<Settings>) {
    const bool is_listed =
        std::ranges::find(hal::kModuleBackEnds, Settings::kName) != hal::kModuleBackEnds.end();
    are_listed &= (Settings::kFacts.origin == hal::CameraOrigin::Module) == is_listed;
  });
  return are_listed;
}());

/// A control of a camera and its value, applied when the camera is opened.
struct ControlSettings {
  std::string name;
  double value = 0;
};

/// Camera of the site.
struct CameraSettings {
  std::string name;  ///< also the name in the rig
  BackEndSettings back_end;
  hal::StreamRequest stream;
  hal::StampSettings stamps;
  signals::RadiometrySettings radiometry;
  hal::SyncPolicy sync = hal::SyncPolicy::Hold;
  hal::TriggerSettings trigger{.mode = hal::TriggerMode::Off};
  std::string trigger_source;  ///< name of a line, or kSoftwareSource
  PixelFormat encoding = PixelFormat::Rgb;
  std::vector<ControlSettings> controls;
  std::vector<hal::ScriptedFault> faults;
  WatchSettings watch;
};

inline constexpr std::array kSyncPolicies{Word{"hold", hal::SyncPolicy::Hold},
                                          Word{"nearest", hal::SyncPolicy::Nearest}};
inline constexpr std::array kTriggerModes{Word{"off", hal::TriggerMode::Off},
                                          Word{"software", hal::TriggerMode::Software},
                                          Word{"line", hal::TriggerMode::Line}};
inline constexpr std::array kTriggerActivations{
    Word{"rising_edge", hal::TriggerActivation::RisingEdge},
    Word{"falling_edge", hal::TriggerActivation::FallingEdge},
    Word{"any_edge", hal::TriggerActivation::AnyEdge}};

template <class Visitor>
void visit(Visitor& v, ControlSettings& control) {
  v.required("name", control.name,
             "GenICam name, for v4l2, libcamera and genicam: ExposureTime (us), Gain, ExposureAuto "
             "and BalanceWhiteAuto (0 off, 1 on); for v4l2 and genicam also GainAuto and "
             "TriggerMode; or the camera's own name, as `orbwatch list` shows it");
  v.required("value", control.value, kAnyNumber,
             "Value in the camera's units; for a menu, the number of the entry");
}

template <class Visitor>
void visit_trigger(Visitor& v, CameraSettings& camera) {
  v.optional(
      "trigger_mode", camera.trigger.mode, kTriggerModes,
      "off: every frame is used; software: each edge requests a frame, from a camera with the "
      "controls TriggerMode and TriggerSoftware or a simulated one; line: the first frame that "
      "begins after an edge, within a second or five periods of its rate, is used, from a camera "
      "that receives the edge or runs freely");
  v.optional("trigger_source", camera.trigger_source,
             "Name of a line with use trigger_in; or software: only the command trigger triggers; "
             "the same for all triggered cameras");
  v.optional("trigger_activation", camera.trigger.activation, kTriggerActivations,
             "Edges of the line that trigger; the same for all triggered cameras");
  v.optional("trigger_delay_us", camera.trigger.delay, Microseconds{Range::between(0, 1e7)},
             "Delay from the edge to the exposure, us");
  const bool triggered = camera.trigger.mode != hal::TriggerMode::Off;
  v.require(triggered != camera.trigger_source.empty(), "trigger_mode",
            "a triggered camera needs trigger_source, and only a triggered camera may set it");
}

template <class Visitor>
void visit(Visitor& v, CameraSettings& camera) {
  v.required("name", camera.name, "Camera's name in the rig, also used by views and messages");
  v.one_of("back_end", camera.back_end, "Source of the camera's frames");
  v.optional(
      "width", camera.stream.width, pipeline::kSide,
      "Picture width, px, equal to the rig's; default: the camera's own, for v4l2 the rig's");
  v.optional(
      "height", camera.stream.height, pipeline::kSide,
      "Picture height, px, equal to the rig's; default: the camera's own, for v4l2 the rig's");
  v.optional("frame_rate", camera.stream.frame_rate, Range::between(0.01, hal::kMaxFrameRate),
             "Frames per second; default: the camera's own");
  v.optional(
      "kelvin_per_count", camera.radiometry.kelvin_per_count, Range::above(0, 10),
      "Radiometric scale of a 16-bit thermal camera, K per count; must equal the scale that the "
      "camera reports, if it reports one. Without the key the camera is not radiometric");
  v.optional("kelvin_offset", camera.radiometry.kelvin_offset, Range::above(-1000, 1000),
             "Temperature at count 0, K: T[K] = kelvin_per_count * count + kelvin_offset; 273.15 "
             "if count 0 is 0 degC");
  v.require(camera.radiometry.kelvin_offset == 0 || camera.radiometry.kelvin_per_count > 0,
            "kelvin_offset", "needs kelvin_per_count");
  v.optional("radiometric", camera.radiometry.states_scale,
             "The camera is a genicam thermal camera that reports its scale; kelvin_per_count may "
             "then be omitted");
  v.table("radiometry", camera.radiometry,
          "Correction of apparent to true temperatures, for radiometric cameras");
  v.optional("sync", camera.sync, kSyncPolicies,
             "When the camera has no frame in the window: `hold` reuses its last one unmeasured, "
             "`nearest` omits the camera");
  visit_trigger(v, camera);
  v.optional("readout_time_us", camera.stamps.readout_time, Microseconds{Range::between(0, 1e6)},
             "Sensor readout time from the first row to the last, from its data sheet, us; for "
             "cameras that stamp the end of a frame, as most V4L2 drivers except USB do");
  v.optional("stamp_offset_us", camera.stamps.offset, Microseconds{Range::between(-1e6, 1e6)},
             "Measured timestamp latency, us; subtracted from the camera's time stamps");
  v.optional(
      "encoding", camera.encoding, pipeline::kEncodings,
      "Encoding of the camera's own pictures over DDS; 16-bit pictures are published as mono16");
  v.table("watch", camera.watch, "Supervision of alignment, focus and cleanliness");
  v.tables("control", camera.controls, 0, 64,
           "Camera controls, applied in this order, for v4l2, libcamera and genicam");
  v.tables("fault", camera.faults, 0, 100, "Scripted faults, for simulated and replay");
  if (const auto* const v4l2 = std::get_if<hal::V4l2Settings>(&camera.back_end)) {
    v.require(v4l2->frame_height == 0 ||
                  v4l2->first_row + std::max(camera.stream.height, 1) <= v4l2->frame_height,
              "height", "v4l2's first_row and the height must not exceed frame_height together");
  }
  const auto* const replay = std::get_if<hal::ReplaySettings>(&camera.back_end);
  v.require(!replay || !replay->source.empty(), "back_end",
            "replay's source is empty; it must name pictures, a recording or a video");
  const auto name =
      std::visit([](const auto& settings) { return settings.kName; }, camera.back_end);
  v.require(!facts_of(camera.back_end).needs_size || (camera.stream.width && camera.stream.height),
            "back_end", std::string(name) + " needs width and height");
}

}  // namespace orbwatch::app::files
