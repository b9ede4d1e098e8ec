#include "app/ports/modbus/map/bits.h"

#include <algorithm>
#include <utility>

#include "app/model/condition.h"

namespace orbwatch::app::modbus {
namespace {

using I = const ProcessImage&;

// Of measurement_bits(), after the cameras, and of fault_bits().
constexpr std::size_t kFirstMeasuredBit = 8;
constexpr std::size_t kFirstHotSpotBit = 16;
constexpr std::size_t kFirstCameraFaultBit = 16;
static_assert(kMaxCameras <= kFirstMeasuredBit && signals::kMaxRegions <= 8);

Bit in_state(std::string name, std::string description, SystemState state) {
  return {std::move(name), std::move(description),
          [state](I image) { return image.live.status.state == state; }};
}

bool any_stands(const Status& status, Severity severity) {
  const auto* end = status.alarms.begin() + status.alarm_count;
  return std::any_of(status.alarms.begin(), end, [severity](const AlarmStatus& alarm) {
    return standing_severity(alarm) == severity;
  });
}

bool any_awaits_acknowledgement(const Status& status) {
  const auto* end = status.alarms.begin() + status.alarm_count;
  return std::any_of(status.alarms.begin(), end, [](const AlarmStatus& alarm) {
    return signals::awaits_acknowledgement(alarm.alarm.state);
  });
}

std::vector<Bit> make_status_bits() {
  return {
      in_state("running", "Every camera delivers", SystemState::Running),
      in_state("degraded", "Some camera has a fault; what the others see is measured",
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
       "A result was refused because the queue was full; until all that wait are acknowledged",
       [](I image) { return image.results.overrun; }},
      {"alarm", "An alarm stands at an alarm level",
       [](I image) { return any_stands(image.live.status, Severity::Alarm); }},
      {"warning", "An alarm stands at a warning level, or because its signal is not measured",
       [](I image) { return any_stands(image.live.status, Severity::Warning); }},
      {"unacknowledged", "An alarm awaits its acknowledgement",
       [](I image) { return any_awaits_acknowledgement(image.live.status); }},
      {"clock_synchronised", "UTC stamps are right: the clock follows a time server",
       [](I image) { return image.live.status.health.clock_synchronised == 1; }},
      {"recipe_refused",
       "A camera refused the settings of the recipe selected last; the one before is measured",
       [](I image) { return image.live.status.recipe_refused; }},
  };
}

std::vector<Bit> make_measurement_bits() {
  std::vector<Bit> bits;
  for (std::size_t i = 0; i < kMaxCameras; ++i) {
    const std::string n = std::to_string(i);
    bits.push_back({"camera_" + n + "_delivers", "Camera " + n + " is configured and has no fault",
                    [i](I image) {
                      const Status& status = image.live.status;
                      return !image.stale && i < status.camera_count &&
                             status.cameras[i].fault == hal::Fault::None;
                    }});
  }
  bits.resize(kFirstMeasuredBit);
  for (std::size_t i = 0; i < signals::kMaxRegions; ++i) {
    const std::string n = std::to_string(i);
    bits.push_back(
        {"region_" + n + "_measured", "Region " + n + " has a quality above 0",
         [i](I image) { return image.live.status.regions[i].quality != Quality::NotMeasured; }});
  }
  bits.resize(kFirstHotSpotBit);
  for (std::size_t i = 0; i < signals::kMaxRegions; ++i) {
    const std::string n = std::to_string(i);
    bits.push_back({"region_" + n + "_hot_spot", "Region " + n + " has a hot spot", [i](I image) {
                      const double present = image.live.status.regions[i].signals.hot_spot_present;
                      return present > 0;  // not for NaN
                    }});
  }
  return bits;
}

std::vector<Bit> make_process_input_bits() {
  std::vector<Bit> bits;
  for (unsigned i = 0; i < 32; ++i) {
    const std::string n = std::to_string(i);
    bits.push_back({"process_input_" + n, "Process input " + n + " of the configuration is active",
                    [i](I image) { return (image.live.status.process_inputs >> i & 1U) != 0; }});
  }
  return bits;
}

std::string numbered(const std::string& before, std::size_t number, const std::string& after) {
  return before + std::to_string(number) + after;
}

/// A bit per alarm. Alarms are numbered from 1, as acknowledge_alarm counts them.
std::vector<Bit> make_alarm_bits(const std::string& name, const std::string& description,
                                 bool (*is_set)(signals::AlarmState)) {
  std::vector<Bit> bits;
  for (std::size_t i = 0; i < signals::kMaxAlarms; ++i) {
    bits.push_back({numbered("alarm_", i + 1, name), numbered("Alarm ", i + 1, description),
                    [i, is_set](I image) {
                      const Status& status = image.live.status;
                      return i < status.alarm_count && is_set(status.alarms[i].alarm.state);
                    }});
  }
  return bits;
}

std::vector<Bit> make_fault_bits() {
  std::vector<Bit> bits{
      {"pipeline_silent", "As the discrete input stale", [](I image) { return image.stale; }},
      {"no_camera", "No camera delivers",
       [](I image) { return image.live.status.state == SystemState::Fault && !image.stale; }},
      {"plc_silent", "plc_heartbeat is supervised and did not change in time",
       [](I image) { return image.plc.silent; }},
      {"result_overrun", "As the discrete input of that name",
       [](I image) { return image.results.overrun; }},
      {"late", "A frame set of the last second took longer than its deadline",
       [](I image) { return image.live.status.load > 1; }},
      {"throttled", "The board has under-voltage, or is too hot: it does not work at full speed",
       [](I image) { return is_throttled(image.live.status.health); }},
      {"clock_not_synchronised", "The clock follows no time server: UTC stamps may be wrong",
       [](I image) { return image.live.status.health.clock_synchronised == 0; }},
  };
  bits.resize(kFirstCameraFaultBit);
  for (std::size_t i = 0; i < kMaxCameras; ++i) {
    const std::string n = std::to_string(i);
    bits.push_back(
        {"camera_" + n, "Camera " + n + " has a fault: see its fault register", [i](I image) {
           const Status& status = image.live.status;
           return i < status.camera_count && status.cameras[i].fault != hal::Fault::None;
         }});
  }
  return bits;
}

}  // namespace

const std::vector<Bit>& status_bits() {
  static const std::vector<Bit> bits = make_status_bits();
  return bits;
}

const std::vector<Bit>& measurement_bits() {
  static const std::vector<Bit> bits = make_measurement_bits();
  return bits;
}

const std::vector<Bit>& process_input_bits() {
  static const std::vector<Bit> bits = make_process_input_bits();
  return bits;
}

const std::vector<Bit>& active_bits() {
  static const std::vector<Bit> bits = make_alarm_bits(
      "_active", " stands: its condition holds, or it is latched", signals::is_active);
  return bits;
}

const std::vector<Bit>& unacknowledged_bits() {
  static const std::vector<Bit> bits = make_alarm_bits(
      "_unacknowledged", " awaits its acknowledgement", signals::awaits_acknowledgement);
  return bits;
}

const std::vector<Bit>& fault_bits() {
  static const std::vector<Bit> bits = make_fault_bits();
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
