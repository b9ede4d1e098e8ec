#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <type_traits>

#include "app/model/field.h"
#include "app/model/health.h"
#include "hal/clock.h"
#include "hal/fault.h"
#include "hal/sync/frame_set.h"
#include "proc/signals/alarm_board.h"
#include "proc/signals/signals.h"

/// What the appliance says of itself, each figure declared once: its line makes the member, and
/// every interface and manual is made by walking the lines (app/model/readings.h, or fields_of()).
namespace orbwatch::app {

using hal::kMaxCameras;
inline constexpr std::size_t kMaxViews = 16;

/// The daemon as a whole. The numbers go to PLC and controller: append, never renumber.
enum class SystemState : std::uint8_t {
  Starting = 0,
  Running = 1,
  Degraded = 2,
  Fault = 3,
  Stopped = 4,
};

/// The one place of the operator's text for each state. Empty for a number that is none.
constexpr std::string_view operator_text(SystemState state) {
  switch (state) {
    case SystemState::Starting:
      return "starting: no frame set yet";
    case SystemState::Running:
      return "running: every camera delivers";
    case SystemState::Degraded:
      return "degraded: a camera has a fault or is late; the others are measured";
    case SystemState::Fault:
      return "fault: no camera delivers, or the pipeline is silent";
    case SystemState::Stopped:
      return "stopped: measuring is switched off; views are published";
  }
  return {};
}

/// Its first word, for logs.
constexpr std::string_view name_of(SystemState state) {
  const std::string_view text = operator_text(state);
  return text.substr(0, text.find(':'));
}

/// How far a region's signals can be trusted. The numbers go to the PLC: append, never renumber.
enum class Quality : std::uint8_t {
  NotMeasured = 0,  ///< no such region, measuring is stopped, or its camera does not deliver
  Good = 1,
  Apparent = 2,  ///< good, but temperatures are apparent: see Radiometry::is_apparent()
};

/// The one place of the operator's text for each quality. Empty for a number that is none.
constexpr std::string_view operator_text(Quality quality) {
  switch (quality) {
    case Quality::NotMeasured:
      return "not measured";
    case Quality::Good:
      return "good";
    case Quality::Apparent:
      return "good, temperatures are apparent";
  }
  return {};
}

/// Where the processor time of a frame set goes. The numbers are places in Status::stages: append,
/// never renumber.
enum class Stage : std::uint8_t {
  Capture = 0,
  Halving = 1,
  Views = 2,
  Measurement = 3,
  Publication = 4,
  Sinks = 5,
};

/// The one place of the operator's text for each stage. Empty for a number that is none.
constexpr std::string_view operator_text(Stage stage) {
  switch (stage) {
    case Stage::Capture:
      return "capture: the cameras' threads, where JPEG is decoded";
    case Stage::Halving:
      return "halving: pictures reduced for views that do not need all of their pixels, and "
             "sharpened";
    case Stage::Views:
      return "views: remapped, merged and coloured";
    case Stage::Measurement:
      return "measurement: the signals of all regions";
    case Stage::Publication:
      return "publication: hand-over to the interfaces, figures and alarms";
    case Stage::Sinks:
      return "sinks: the interfaces' threads, where pictures are encoded";
  }
  return {};
}

inline constexpr std::size_t kStages = static_cast<std::size_t>(Stage::Sinks) + 1;

/// Its first word.
constexpr std::string_view name_of(Stage stage) {
  const std::string_view text = operator_text(stage);
  return text.substr(0, text.find(':'));
}

/// A signal's place in signals::kSignals, as a code whose text is the signal's name.
enum class SignalNumber : std::uint16_t {};

constexpr std::string_view operator_text(SignalNumber number) {
  const auto index = static_cast<std::size_t>(number);
  return index < signals::kSignals.size() ? signals::kSignals[index].name : std::string_view{};
}

#define ORBWATCH_SYSTEM_FIGURES(FIELD, AGE)                                                        \
  FIELD(SystemState, state, kCode, "State of the appliance")                                       \
  FIELD(std::uint64_t, heartbeat, kCount,                                                          \
        "Advances with the pipeline, at least ten times a second")                                 \
  FIELD(std::uint64_t, frame_set, kCount,                                                          \
        "Number of the newest frame set, which the signals belong to; 0: none yet")                \
  AGE(stamp, "Time since the exposure start of that frame set")                                    \
  FIELD(std::uint64_t, trigger, kCount, "Number of the trigger that began it; 0: not triggered")   \
  FIELD(std::uint64_t, result, kCount,                                                             \
        "Number of the newest result, the measurement of a triggered frame set; 0: none yet")      \
  FIELD(std::uint16_t, recipe, kCode, "Number of the recipe that everything was measured with")    \
  FIELD(std::uint32_t, configuration_checksum, kCount,                                             \
        "CRC-32 of the files of configuration, rig and recipes")                                   \
  FIELD(bool, recipe_refused, kFlag,                                                               \
        "A camera refused the settings of the recipe selected last; the one before is measured")   \
  FIELD(bool, process_active, kFlag,                                                               \
        "The process runs; while it does not, alarms that depend on it are suppressed")            \
  FIELD(std::uint32_t, process_inputs, kCount,                                                     \
        "Bit n: process input n of the configuration is active")                                   \
  FIELD(std::uint16_t, selected_view, kCode, "Index of the selected view, from 0")                 \
  FIELD(std::uint64_t, overruns, kCount, "Frame sets that took longer than their deadline")        \
  FIELD(std::uint64_t, unmatched, kCount,                                                          \
        "Frame sets in which a camera had no frame within the window")                             \
  FIELD(double, skew_ms, kLatency,                                                                 \
        "Largest skew between the exposure starts of a frame set, over the last full second")      \
  FIELD(double, load, kShare,                                                                      \
        "Share of its deadline that the slowest frame set of the last second took")                \
  FIELD(std::uint32_t, process_inputs_known, kCount,                                               \
        "Bit n: process input n is read; otherwise its line has a fault, and the input counts as " \
        "inactive")                                                                                \
  FIELD(std::uint32_t, line_faults, kCount,                                                        \
        "Bit n: line n of the configuration is missing or has a fault")                            \
  FIELD(std::uint32_t, interface_faults, kCount,                                                   \
        "Bit n: an interface cannot be opened: 0 console, 1 Modbus, 2 DDS, 3 snapshots, 4 web")    \
  FIELD(double, busy_ms, kProcessorTime,                                                           \
        "Processor time of the pipeline's own thread for the newest frame set; a lower bound of "  \
        "its duration")                                                                            \
  FIELD(bool, realtime, kFlag,                                                                     \
        "The frame path has real-time priorities: other programs do not delay it")                 \
  FIELD(bool, memory_locked, kFlag, "No page of memory that was used is swapped out")              \
  FIELD(bool, configuration_refused, kFlag,                                                        \
        "The configuration files are invalid: the last good configuration runs, the log has the "  \
        "reason")

inline constexpr Quantity kShare{"", 0.001, 0, 1000};
inline constexpr Quantity kProcessorTime{"ms", 0.001, 0, 100000};

/// The appliance as a whole.
struct SystemStatus {
  ORBWATCH_SYSTEM_FIGURES(ORBWATCH_FIELD_MEMBER, ORBWATCH_AGE_MEMBER)
};

/// How what is watched of a camera stands to its limits. The numbers go to the PLC: append, never
/// renumber.
enum class WatchLevel : std::uint8_t {
  NotMeasured = 0,  ///< not watched, no picture, darkness, or nothing learnt yet
  Good = 1,
  Warning = 2,
  Alarm = 3,
};

/// The one place of the operator's text for each level. Empty for a number that is none.
constexpr std::string_view operator_text(WatchLevel level) {
  switch (level) {
    case WatchLevel::NotMeasured:
      return "not measured";
    case WatchLevel::Good:
      return "good";
    case WatchLevel::Warning:
      return "beyond its warning limit";
    case WatchLevel::Alarm:
      return "beyond its alarm limit";
  }
  return {};
}

/// State of a camera's alignment: a WatchLevel, or that it has none. The numbers go to the
/// PLC: append, never renumber.
enum class AlignmentLevel : std::uint8_t {
  NotMeasured = 0,
  Good = 1,
  Warning = 2,
  Alarm = 3,
  NotRegistered = 4,  ///< the rig does not say where it looks
};

/// The same level by its number.
constexpr AlignmentLevel alignment_level(WatchLevel level) {
  return static_cast<AlignmentLevel>(level);
}

/// The one place of the operator's text for each level. Empty for a number that is none.
constexpr std::string_view operator_text(AlignmentLevel level) {
  if (level == AlignmentLevel::NotRegistered) {
    return "not registered, and left out of merged and measured views";
  }
  return operator_text(static_cast<WatchLevel>(level));
}

/// What has become of the alignment that was asked for last. The numbers go to the PLC: append,
/// never renumber.
enum class ProposalState : std::uint8_t {
  None = 0,
  Working = 1,
  Ready = 2,
  Refused = 3,
};

/// The one place of the operator's text for each state. Empty for a number that is none.
constexpr std::string_view operator_text(ProposalState state) {
  switch (state) {
    case ProposalState::None:
      return "nothing is proposed";
    case ProposalState::Working:
      return "an alignment or a point is being computed";
    case ProposalState::Ready:
      return "an alignment is proposed: accept or discard it";
    case ProposalState::Refused:
      return "none was found; the log has the reason";
  }
  return {};
}

#define ORBWATCH_WATCH_FIGURES(FIELD)                                                              \
  FIELD(AlignmentLevel, alignment, kCode,                                                          \
        "State of the alignment: the ball's position compared with that of the alignment")         \
  FIELD(double, drift_error, kAngle,                                                               \
        "Error of the directions that views show, rms, since it was aligned")                      \
  FIELD(double, drift_shift, kPercent, "Shift of the ball's picture, relative to its radius")      \
  FIELD(WatchLevel, focus, kCode, "Sharpness of the reflection in the ball")                       \
  FIELD(double, blur, kBlur,                                                                       \
        "Blur of the reflection in the ball: sigma of a Gaussian, pixel size included")            \
  FIELD(WatchLevel, cleanliness, kCode, "Cleanliness of the ball")                                 \
  FIELD(double, contamination, kPercent,                                                           \
        "Share of the ball's picture under spots and scratches that appeared after it was learnt") \
  FIELD(ProposalState, proposal, kCode, "State of the alignment requested last")                   \
  FIELD(double, proposal_error, kAngle,                                                            \
        "One sigma of the directions of the proposed alignment, estimated from its residuals; "    \
        "not valid without a proposal, and for detect_ball")                                       \
  FIELD(std::uint64_t, marked_points, kCount,                                                      \
        "Points that mark_point added for place_camera since the start")

inline constexpr Quantity kAngle{"deg", 0.001, 0, 180};
inline constexpr Quantity kPercent{"%", 0.01, 0, 10000};
inline constexpr Quantity kBlur{"px", 0.01, 0, 1000};

/// What a figure is until it is measured.
template <class T>
inline constexpr T kNotMeasured{};
template <>
inline constexpr double kNotMeasured<double> = signals::kNotValid;
#define ORBWATCH_WATCH_MEMBER(type, name, quantity, description) type name = kNotMeasured<type>;

/// What is watched of a camera beside the frame path; numbers are not valid where their level is
/// not measured.
struct CameraWatchStatus {
  ORBWATCH_WATCH_FIGURES(ORBWATCH_WATCH_MEMBER)
};

#define ORBWATCH_CAMERA_FIGURES(FIELD, AGE)                                                        \
  FIELD(hal::Fault, fault, kCode, "Fault of the camera")                                           \
  FIELD(double, frames_per_second, kRate, "Frame rate over the last full second")                  \
  FIELD(double, latency_p50_ms, kLatency,                                                          \
        "Exposure start to arrival, median of the last full second")                               \
  FIELD(double, latency_p99_ms, kLatency, "Exposure start to arrival, 99 of 100 are faster")       \
  AGE(last_frame, "Time since the arrival of the newest good frame")                               \
  FIELD(std::uint64_t, frames, kCount, "Frames delivered since start")                             \
  FIELD(std::uint64_t, lost, kCount, "Frames missing in the camera's sequence")                    \
  FIELD(                                                                                           \
      std::uint64_t, dropped, kCount,                                                              \
      "Frames not used: superseded by a newer one, the queue was full, or the camera had a fault") \
  FIELD(std::uint64_t, unmatched, kCount,                                                          \
        "Frames delivered without a simultaneous frame of the pacing camera")                      \
  FIELD(std::uint64_t, triggers, kCount, "Edges of the camera's trigger line since start")         \
  FIELD(std::uint64_t, missed, kCount,                                                             \
        "Triggers without a frame: faster than the camera, during its fault, or the frame was "    \
        "damaged")                                                                                 \
  FIELD(std::uint64_t, damaged, kCount,                                                            \
        "Damaged frames, which are discarded; 5 of the last 20 are a fault")                       \
  FIELD(std::uint64_t, flawed, kCount,                                                             \
        "Frames used although their JPEG data has padding before a marker, or no end marker")

#define ORBWATCH_LINK_FIGURES(FIELD)                                                    \
  FIELD(std::uint64_t, missing_packets, kCount,                                         \
        "Packets of a GigE Vision camera that never arrived; their frames are damaged") \
  FIELD(std::uint64_t, resent_packets, kCount,                                          \
        "Packets of a GigE Vision camera that arrived after a resend request")          \
  FIELD(std::uint64_t, underruns, kCount,                                               \
        "Packets of a GigE Vision camera, or frames of a USB3 Vision one, without a buffer")

/// One camera.
struct CameraStatus : CameraWatchStatus {
  ORBWATCH_CAMERA_FIGURES(ORBWATCH_FIELD_MEMBER, ORBWATCH_AGE_MEMBER)
  ORBWATCH_LINK_FIGURES(ORBWATCH_FIELD_MEMBER)
};

#define ORBWATCH_VIEW_FIGURES(FIELD)                                                           \
  FIELD(std::uint64_t, published, kCount, "Views published since start")                       \
  FIELD(std::uint64_t, skipped, kCount,                                                        \
        "Frame sets without this view: display slowed down, or no buffer")                     \
  FIELD(std::uint64_t, superseded, kCount,                                                     \
        "Pointing requests that a newer one replaced before the next frame set")               \
  FIELD(double, frames_per_second, kRate, "Frame rate over the last full second")              \
  FIELD(double, latency_p50_ms, kLatency,                                                      \
        "Exposure start to hand-over to the sinks, median of the last full second")            \
  FIELD(double, latency_p99_ms, kLatency, "Exposure start to hand-over, 99 of 100 are faster") \
  FIELD(bool, live, kFlag, "Its recipe, if any, is selected and one of its cameras has no fault")

/// One view.
struct ViewStatus {
  ORBWATCH_VIEW_FIGURES(ORBWATCH_FIELD_MEMBER)
};

/// What one region of the recipe measured in the newest frame set. Its fields are its quality and
/// every signal of signals::kSignals.
struct RegionStatus {
  Quality quality = Quality::NotMeasured;
  signals::Signals signals;
};

#define ORBWATCH_STAGE_FIGURES(FIELD)                                       \
  FIELD(double, cpu_ms, kProcessorTime,                                     \
        "Processor time for the newest frame set, of all threads together") \
  FIELD(double, cpu_p50_ms, kProcessorTime,                                 \
        "Processor time per frame set, median of the last full second")     \
  FIELD(double, cpu_p99_ms, kProcessorTime, "Processor time per frame set, 99 of 100 took less")

/// One stage.
struct StageStatus {
  ORBWATCH_STAGE_FIGURES(ORBWATCH_FIELD_MEMBER)
};

#define ORBWATCH_ALARM_FIGURES(FIELD, AGE)                                      \
  FIELD(std::uint16_t, region, kCode, "Index of the supervised region, from 0") \
  FIELD(SignalNumber, signal, kCode, "Supervised signal")                       \
  FIELD(double, value, kSignalValue, "Value of that signal, in its unit")       \
  AGE(since, "Time since the alarm's state changed; not valid before the first change")

inline constexpr Quantity kSignalValue{"", 1, -2147483647, 2147483647};

/// One alarm of the recipe. Its fields begin with those of `alarm`.
struct AlarmStatus {
  signals::Alarm alarm;
  ORBWATCH_ALARM_FIGURES(ORBWATCH_FIELD_MEMBER, ORBWATCH_AGE_MEMBER)
};

/// One consistent copy of everything the outside may know at one moment. Fixed size, no heap: it is
/// copied to every sink.
struct Status : SystemStatus {
  std::size_t camera_count = 0;
  std::size_t view_count = 0;
  std::size_t region_count = 0;
  std::size_t alarm_count = 0;
  std::array<CameraStatus, kMaxCameras> cameras;
  std::array<ViewStatus, kMaxViews> views;
  std::array<AlarmStatus, signals::kMaxAlarms> alarms;
  std::array<RegionStatus, signals::kMaxRegions> regions;
  Health health;
  std::array<StageStatus, kStages> stages;  ///< by Stage
};

/// Calls `visit(field)` for every field of a part, in the order in which interfaces number them. A
/// field is a Field<Get>: its facts, and std::invoke(field.get, part) for its value.
template <class Visit>
constexpr void for_each_field(std::type_identity<SystemStatus>, Visit&& visit) {
  using Part = SystemStatus;
  ORBWATCH_SYSTEM_FIGURES(ORBWATCH_VISIT_FIELD, ORBWATCH_VISIT_AGE)
}

template <class Visit>
constexpr void for_each_field(std::type_identity<Health>, Visit&& visit) {
  for (const HealthField& figure : kHealthFigures) visit(figure);
}

template <class Visit>
constexpr void for_each_field(std::type_identity<CameraWatchStatus>, Visit&& visit) {
  using Part = CameraWatchStatus;
  ORBWATCH_WATCH_FIGURES(ORBWATCH_VISIT_FIELD)
}

template <class Visit>
constexpr void for_each_field(std::type_identity<CameraStatus>, Visit&& visit) {
  using Part = CameraStatus;
  ORBWATCH_CAMERA_FIGURES(ORBWATCH_VISIT_FIELD, ORBWATCH_VISIT_AGE)
  for_each_field(std::type_identity<CameraWatchStatus>{}, visit);
  ORBWATCH_LINK_FIGURES(ORBWATCH_VISIT_FIELD)
}

template <class Visit>
constexpr void for_each_field(std::type_identity<ViewStatus>, Visit&& visit) {
  using Part = ViewStatus;
  ORBWATCH_VIEW_FIGURES(ORBWATCH_VISIT_FIELD)
}

template <class Visit>
constexpr void for_each_field(std::type_identity<StageStatus>, Visit&& visit) {
  using Part = StageStatus;
  ORBWATCH_STAGE_FIGURES(ORBWATCH_VISIT_FIELD)
}

/// Reads one signal of a region.
struct SignalOf {
  double signals::Signals::*member;
  double operator()(const RegionStatus& region) const { return region.signals.*member; }
};

template <class Visit>
constexpr void for_each_field(std::type_identity<RegionStatus>, Visit&& visit) {
  visit(make_field("quality", kCode, "Reliability of the signals", &RegionStatus::quality));
  for (const signals::SignalInfo& info : signals::kSignals) {
    visit(make_field(info.name, {info.unit, info.scale, info.minimum, info.maximum},
                     info.description, SignalOf{info.member}));
  }
}

/// The unit and resolution of its value are those of the signal: see quantity_of(AlarmStatus).
template <class Visit>
constexpr void for_each_field(std::type_identity<AlarmStatus>, Visit&& visit) {
  visit(make_field("state", kCode, "Alarm state by ISA-18.2",
                   [](const AlarmStatus& a) { return a.alarm.state; }));
  visit(make_field("level", kCode, "Present level of the signal",
                   [](const AlarmStatus& a) { return a.alarm.level; }));
  visit(make_field("announced", kCode, "Worst level that is not acknowledged, or is latched",
                   [](const AlarmStatus& a) { return a.alarm.announced; }));
  visit(make_field("measurement_lost", kFlag, "The signal is not measured",
                   [](const AlarmStatus& a) { return a.alarm.measurement_lost; }));
  using Part = AlarmStatus;
  ORBWATCH_ALARM_FIGURES(ORBWATCH_VISIT_FIELD, ORBWATCH_VISIT_AGE)
}

/// Unit and resolution of the value of an alarm's signal.
constexpr Quantity quantity_of(const AlarmStatus& alarm) {
  const auto index = static_cast<std::size_t>(alarm.signal);
  if (index >= signals::kSignals.size()) return {};
  const signals::SignalInfo& info = signals::kSignals[index];
  return {info.unit, info.scale, info.minimum, info.maximum};
}

}  // namespace orbwatch::app
