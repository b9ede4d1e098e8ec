#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "app/health/health.h"
#include "hal/clock.h"
#include "hal/fault.h"
#include "hal/frame_set.h"
#include "proc/signals/alarm_board.h"
#include "proc/signals/signals.h"

namespace orbwatch::app {

using hal::kMaxCameras;
inline constexpr std::size_t kMaxViews = 16;

/// The daemon as a whole. The numbers go to PLC and controller: append, never renumber.
enum class SystemState : std::uint8_t {
  Starting = 0,  ///< no frame set yet
  Running = 1,   ///< every camera delivers
  Degraded = 2,  ///< some camera has a fault; what the others see is still measured
  Fault = 3,     ///< no camera delivers
  Stopped = 4,   ///< told to stop measuring; cameras and display views go on
};

/// The name of a state in logs and manuals.
constexpr std::string_view name_of(SystemState state) {
  constexpr std::array<std::string_view, 5> kNames{"starting", "running", "degraded", "fault",
                                                   "stopped"};
  return kNames[static_cast<std::size_t>(state)];
}

/// How far a region's signals can be trusted. The numbers go to the PLC: append, never renumber.
enum class Quality : std::uint8_t {
  NotMeasured = 0,  ///< no such region, measuring is stopped, or its camera does not deliver
  Good = 1,
  Apparent = 2,  ///< good, but temperatures are apparent: see Radiometry::is_apparent()
};

/// The name of a quality in manuals.
constexpr std::string_view name_of(Quality quality) {
  constexpr std::array<std::string_view, 3> kNames{"not measured", "good",
                                                   "good, temperatures are apparent"};
  return kNames[static_cast<std::size_t>(quality)];
}

/// What one region of the recipe measured in the newest frame set.
struct RegionStatus {
  Quality quality = Quality::NotMeasured;
  signals::Signals signals;
};

/// One alarm of the recipe, and what it watches.
struct AlarmStatus {
  signals::Alarm alarm;
  std::size_t region = 0;
  std::size_t signal = 0;             ///< index in signals::kSignals
  double value = signals::kNotValid;  ///< of that signal
  hal::TimePoint since{};             ///< its state; the epoch: it has never had another
};

/// What happened to an alarm.
struct AlarmNotice {
  std::uint64_t number = 0;  ///< counts notices from 1
  signals::AlarmEvent event;
  std::size_t region = 0;
  std::size_t signal = 0;
  std::uint16_t recipe = 0;
  std::uint64_t frame_set = 0;  ///< the newest one then
  hal::TimePoint stamp{};       ///< of that frame set, or of the moment without one
};

/// Figures of one camera since start; rates and latencies over the last full second.
struct CameraStatus {
  hal::Fault fault = hal::Fault::None;
  std::uint64_t frames = 0;     ///< delivered
  std::uint64_t lost = 0;       ///< gaps in the sequence
  std::uint64_t dropped = 0;    ///< delivered, but the pipeline was late or the camera failed
  std::uint64_t unmatched = 0;  ///< delivered while the pacing camera had no frame of that moment
  double frames_per_second = 0;
  double latency_p50_ms = 0;  ///< exposure start to arrival
  double latency_p99_ms = 0;
  std::uint64_t triggers = 0;   ///< edges of its trigger line; 0 without one
  std::uint64_t missed = 0;     ///< triggers without a frame: faster than the camera, or its fault
  hal::TimePoint last_frame{};  ///< arrival of the newest good frame; the epoch: none yet
};

/// Figures of one view since start; rates and latencies over the last full second.
struct ViewStatus {
  std::uint64_t published = 0;
  std::uint64_t skipped = 0;  ///< frame sets without this view: display slowed down, or no buffer
  double frames_per_second = 0;
  double latency_p50_ms = 0;  ///< exposure start to hand-over to the sinks
  double latency_p99_ms = 0;
  std::uint64_t superseded = 0;  ///< requests to point it, replaced by a newer one before a frame
};

/// One consistent copy of everything the outside may know at one moment. Fixed size, no heap: it is
/// copied to every sink.
struct Status {
  SystemState state = SystemState::Starting;
  std::uint64_t heartbeat = 0;  ///< advances with the pipeline, at least ten times a second
  std::uint64_t frame_set = 0;  ///< number of the newest frame set; 0: none yet
  hal::TimePoint stamp;         ///< exposure start of that frame set
  std::uint64_t trigger = 0;    ///< number of the trigger that began it; 0: none did
  /// Number of the newest result, which is that of a frame set with a trigger: when it changes,
  /// this status is that result. 0: none yet.
  std::uint64_t result = 0;
  std::uint16_t recipe = 0;  ///< number of the recipe that everything here was measured with
  /// CRC-32 of the files of configuration, rig and recipes.
  std::uint32_t configuration_checksum = 0;
  bool recipe_refused = false;  ///< a camera refused the settings of the recipe selected last
  bool process_active = false;  ///< outside it, no process alarm is raised
  std::uint64_t overruns = 0;   ///< frame sets that took longer than their deadline
  std::uint64_t unmatched = 0;  ///< frame sets in which a camera had no frame within the window
  double skew_ms = 0;           ///< largest between the exposures of a set, of the last full second
  double load = 0;              ///< share of the deadline the slowest set of the last second took
  std::uint32_t process_inputs = 0;  ///< bit n: the configuration's nth process input is active
  std::size_t selected_view = 0;
  std::size_t camera_count = 0;
  std::size_t view_count = 0;
  std::array<CameraStatus, kMaxCameras> cameras;
  std::size_t region_count = 0;
  std::size_t alarm_count = 0;
  std::array<ViewStatus, kMaxViews> views;
  std::array<AlarmStatus, signals::kMaxAlarms> alarms;
  Health health;
  std::array<RegionStatus, signals::kMaxRegions> regions;
};

}  // namespace orbwatch::app
