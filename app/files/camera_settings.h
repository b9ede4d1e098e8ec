#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "app/model/watch_settings.h"
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

namespace orbwatch::app {

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
  v.required(
      "name", control.name,
      "GenICam's, for v4l2, libcamera and genicam: ExposureTime (us), Gain, and ExposureAuto "
      "and BalanceWhiteAuto (0 off, 1 on), for v4l2 and genicam GainAuto and TriggerMode, "
      "too; or the camera's own, as `orbwatch list` shows it");
  v.required("value", control.value, kAnyNumber,
             "In the camera's units; for a menu, the entry's number");
}

template <class Visitor>
void visit_trigger(Visitor& v, CameraSettings& camera) {
  v.optional("trigger_mode", camera.trigger.mode, kTriggerModes,
             "off: every frame counts; software: each edge asks the camera for a frame, of a "
             "camera with the controls TriggerMode and TriggerSoftware or a simulated one; line: "
             "the frame that begins after an edge counts, of a camera that receives the edge or "
             "runs freely");
  v.optional("trigger_source", camera.trigger_source,
             "Name of the line, whose use is trigger_in; or software: only the command trigger "
             "does");
  v.optional("trigger_activation", camera.trigger.activation, kTriggerActivations,
             "Which of its edges are triggers");
  v.optional("trigger_delay_us", camera.trigger.delay, Microseconds{Range::between(0, 1e7)},
             "From the edge to the exposure, us");
  const bool triggered = camera.trigger.mode != hal::TriggerMode::Off;
  v.require(triggered != camera.trigger_source.empty(), "trigger_mode",
            "a triggered camera needs trigger_source, and only that");
}

template <class Visitor>
void visit(Visitor& v, CameraSettings& camera) {
  v.required("name", camera.name, "Its name in the rig; views and messages use it too");
  v.one_of("back_end", camera.back_end, "Where its frames come from");
  v.optional("width", camera.stream.width, kSide,
             "Picture width, px, as in the rig; else the camera's own, of v4l2 the rig's");
  v.optional("height", camera.stream.height, kSide,
             "Picture height, px, as in the rig; else the camera's own, of v4l2 the rig's");
  v.optional("frame_rate", camera.stream.frame_rate, Range::between(0.01, hal::kMaxFrameRate),
             "Frames per second; else the camera's own");
  v.optional("kelvin_per_count", camera.radiometry.kelvin_per_count, Range::above(0, 10),
             "Radiometric scale of a 16-bit thermal camera, which must be the one that the camera "
             "says, if it does; else it is none");
  v.optional("kelvin_offset", camera.radiometry.kelvin_offset, Range::above(-1000, 1000),
             "Temperature of its count 0, K: T[K] = kelvin_per_count * count + kelvin_offset; "
             "273.15 where counts begin at 0 degC");
  v.require(camera.radiometry.kelvin_offset == 0 || camera.radiometry.kelvin_per_count > 0,
            "kelvin_offset", "needs kelvin_per_count");
  v.optional(
      "radiometric", camera.radiometry.says_scale,
      "It is a thermal camera, genicam, that says kelvin_per_count itself, which need not be "
      "stated then");
  v.table("radiometry", camera.radiometry,
          "Of a radiometric camera: makes true temperatures of apparent ones");
  v.optional("sync", camera.sync, kSyncPolicies,
             "In a set without a frame of it within the window: hold its last one, which is not "
             "measured again, or nearest, which leaves it out");
  visit_trigger(v, camera);
  v.optional(
      "readout_time_us", camera.stamps.readout_time, Microseconds{Range::between(0, 1e6)},
      "From the first row to the last, of the sensor's data sheet, us: for cameras that stamp "
      "the end of a frame, as most V4L2 drivers but USB's do");
  v.optional("stamp_offset_us", camera.stamps.offset, Microseconds{Range::between(-1e6, 1e6)},
             "How much later its time stamps are than they should be, as measured, us");
  v.optional("encoding", camera.encoding, kEncodings,
             "Of its own pictures over DDS; 16-bit ones go out as mono16");
  v.table("watch", camera.watch, "Whether it still sees the ball where it was aligned");
  v.tables("control", camera.controls, 0, 64,
           "Settings of the camera, applied in this order, for v4l2, libcamera and genicam");
  v.tables("fault", camera.faults, 0, 100, "Faults to show, for simulated and replay");
  if (const auto* const v4l2 = std::get_if<hal::V4l2Settings>(&camera.back_end)) {
    v.require(v4l2->frame_height == 0 ||
                  v4l2->first_row + std::max(camera.stream.height, 1) <= v4l2->frame_height,
              "height", "v4l2's first_row and the height must not exceed frame_height together");
  }
  const auto name =
      std::visit([](const auto& settings) { return settings.kName; }, camera.back_end);
  v.require(!facts_of(camera.back_end).needs_size || (camera.stream.width && camera.stream.height),
            "back_end", std::string(name) + " needs width and height");
}

}  // namespace orbwatch::app
