// SPDX-License-Identifier: Apache-2.0
#include "app/ports/modbus/map/bits.h"

#include <algorithm>
#include <span>
#include <utility>

#include "app/model/status/condition.h"

namespace orbwatch::app::modbus {
namespace {

using I = const ProcessImage&;

// First bits of measurement_bits() after the cameras, and of fault_bits().
constexpr std::size_t kFirstMeasuredBit = 8;
constexpr std::size_t kFirstHotSpotBit = 16;
constexpr std::size_t kFirstCameraFaultBit = 16;
static_assert(kMaxCameras <= kFirstMeasuredBit && signals::kMaxRegions <= 8);

Bit in_state(std::string name, std::string description, SystemState state) {
  return {std::move(name), std::move(description),
          [state](I image) { return image.live.status.state == state; }};
}

std::span<const AlarmStatus> alarms_of(const Status& status) {
  return std::span(status.alarms).first(status.alarm_count);
}

bool any_stands(const Status& status, Severity severity) {
  return std::ranges::any_of(alarms_of(status), [severity](const AlarmStatus& alarm) {
    return standing_severity(alarm) == severity;
  });
}

/// Beyond a limit, or not registered.
bool is_misaligned(AlignmentLevel level) {
  return level >= AlignmentLevel::Warning && level <= AlignmentLevel::NotRegistered;
}

bool any_awaits_acknowledgement(const Status& status) {
  return std::ranges::any_of(alarms_of(status), [](const AlarmStatus& alarm) {
    return signals::awaits_acknowledgement(alarm.alarm.state);
  });
}

/// Replaces each '#' by `number`.
std::string numbered(std::string_view text, std::size_t number) {
  std::string result;
  for (const char c : text) result += c == '#' ? std::to_string(number) : std::string(1, c);
  return result;
}

/// A bit for each entry of a list, numbered from `first`. `is_set` gets the process image and the
/// entry's place.
template <class IsSet>
void append(std::vector<Bit>& bits, std::size_t count, std::string_view name,
            std::string_view description, IsSet is_set, std::size_t first = 0) {
  for (std::size_t i = 0; i < count; ++i) {
    bits.push_back({numbered(name, first + i), numbered(description, first + i),
                    [i, is_set](I image) { return is_set(image, i); }});
  }
}

/// A bit per alarm. Alarms are numbered from 1, like the argument of acknowledge_alarm.
std::vector<Bit> alarm_bits(std::string_view name, std::string_view description,
                            bool (*is_set)(signals::AlarmState)) {
  std::vector<Bit> bits;
  append(
      bits, signals::kMaxAlarms, name, description,
      [is_set](I image, std::size_t i) {
        const Status& status = image.live.status;
        return i < status.alarm_count && is_set(status.alarms[i].alarm.state);
      },
      1);
  return bits;
}

}  // namespace

std::vector<Bit> status_bits() {
  return {
      in_state("running", "Every camera delivers", SystemState::Running),
      in_state("degraded", "A camera has a fault or is late; the others are measured",
               SystemState::Degraded),
      in_state("fault", "No camera delivers, or the pipeline is silent", SystemState::Fault),
      in_state("stopped", "Measuring is switched off", SystemState::Stopped),
      {"stale", "The pipeline is silent: the state reads fault and no region's signal is valid",
       [](I image) { return image.stale; }},
      {"process_active",
       "The process runs; while it does not, alarms that depend on it are suppressed",
       [](I image) { return image.live.status.process_active; }},
      {"plc_alive", "plc_heartbeat is supervised and changed in time",
       [](I image) { return image.plc.alive; }},
      {"result_available", "A result waits in the result window",
       [](I image) { return image.results.count > 0; }},
      {"result_overrun",
       "A result was refused because the queue was full; set until all waiting results are "
       "acknowledged",
       [](I image) { return image.results.overrun; }},
      {"alarm", "An alarm is active at an alarm level",
       [](I image) { return any_stands(image.live.status, Severity::Alarm); }},
      {"warning", "An alarm is active at a warning level, or because its signal is not measured",
       [](I image) { return any_stands(image.live.status, Severity::Warning); }},
      {"unacknowledged", "An alarm awaits its acknowledgement",
       [](I image) { return any_awaits_acknowledgement(image.live.status); }},
      {"clock_synchronised", "UTC stamps are valid: the clock follows a time server",
       [](I image) { return image.live.status.health.clock_synchronised == 1; }},
      {"recipe_refused",
       "A camera refused the settings of the recipe selected last; the one before is measured",
       [](I image) { return image.live.status.recipe_refused; }},
  };
}

std::vector<Bit> measurement_bits() {
  std::vector<Bit> bits;
  append(bits, kMaxCameras, "camera_#_delivers", "Camera # is configured and has no fault",
         [](I image, std::size_t i) {
           const Status& status = image.live.status;
           return !image.stale && i < status.camera_count &&
                  status.cameras[i].fault == hal::Fault::None;
         });
  bits.resize(kFirstMeasuredBit);
  append(bits, signals::kMaxRegions, "region_#_measured", "Region # has a quality above 0",
         [](I image, std::size_t i) {
           return image.live.status.regions[i].quality != Quality::NotMeasured;
         });
  bits.resize(kFirstHotSpotBit);
  append(bits, signals::kMaxRegions, "region_#_hot_spot", "Region # has a hot spot",
         [](I image, std::size_t i) {
           const double present = image.live.status.regions[i].signals.hot_spot_present;
           return present > 0;  // false for NaN
         });
  return bits;
}

std::vector<Bit> process_input_bits() {
  std::vector<Bit> bits;
  append(bits, 32, "process_input_#", "Process input # of the configuration is active",
         [](I image, std::size_t i) { return (image.live.status.process_inputs >> i & 1U) != 0; });
  return bits;
}

std::vector<Bit> active_bits() {
  return alarm_bits("alarm_#_active", "Alarm # is active: its condition holds, or it is latched",
                    signals::is_active);
}

std::vector<Bit> unacknowledged_bits() {
  return alarm_bits("alarm_#_unacknowledged", "Alarm # awaits its acknowledgement",
                    signals::awaits_acknowledgement);
}

std::vector<Bit> fault_bits() {
  std::vector<Bit> bits{
      {"pipeline_silent", "Same as the discrete input stale", [](I image) { return image.stale; }},
      {"no_camera", "No camera delivers",
       [](I image) { return image.live.status.state == SystemState::Fault && !image.stale; }},
      {"plc_silent", "plc_heartbeat is supervised and did not change in time",
       [](I image) { return image.plc.silent; }},
      {"result_overrun", "Same as the discrete input result_overrun",
       [](I image) { return image.results.overrun; }},
      {"late", "A frame set of the last second took longer than its deadline",
       [](I image) { return image.live.status.load > 1; }},
      {"throttled", "The board has under-voltage or is too hot, and runs below full speed",
       [](I image) { return is_throttled(image.live.status.health); }},
      {"clock_not_synchronised", "The clock follows no time server: UTC stamps may be wrong",
       [](I image) { return image.live.status.health.clock_synchronised == 0; }},
      {"commands_not_recorded",
       "The state folder is not usable: after a restart the first command is not executed",
       [](I image) { return image.live.status.health.commands_recorded == 0; }},
      {"machine_unknown", "The machine's states are missing or stale: see its register quality",
       [](I image) { return is_fault(image.live.status.machine.quality); }},
      {"under_voltage", "The voltage of the board's supply is too low: it may stop at any moment",
       [](I image) { return has_under_voltage(image.live.status.health); }},
  };
  bits.resize(kFirstCameraFaultBit);
  append(bits, kMaxCameras, "camera_#", "Camera # has a fault: see its fault register",
         [](I image, std::size_t i) {
           const Status& status = image.live.status;
           return i < status.camera_count && status.cameras[i].fault != hal::Fault::None;
         });
  append(
      bits, kMaxCameras, "camera_#_moved",
      "Camera # is misaligned or not registered: see its alignment register",
      [](I image, std::size_t i) { return is_misaligned(image.live.status.cameras[i].alignment); });
  append(bits, kMaxCameras, "camera_#_maintenance",
         "Camera # is out of focus or the ball is dirty: see its registers focus and cleanliness",
         [](I image, std::size_t i) {
           const CameraStatus& camera = image.live.status.cameras[i];
           return std::max(camera.focus, camera.cleanliness) >= WatchLevel::Warning;
         });
  append(bits, kMaxCameras, "camera_#_not_aligned",
         "The stated outline of camera # is not that of its ball: see its register outline_check",
         [](I image, std::size_t i) {
           return image.live.status.cameras[i].outline_check == OutlineState::NotAligned;
         });
  return bits;
}

std::uint32_t word_of(const std::vector<Bit>& bits, const ProcessImage& image) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (bits[i].is_set && bits[i].is_set(image)) word |= 1U << i;
  }
  return word;
}

}  // namespace orbwatch::app::modbus
