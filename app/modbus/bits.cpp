#include "app/modbus/bits.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/modbus/alarm_summary.h"

namespace orbwatch::app::modbus {
namespace {

using S = const Snapshot&;

Bit in_state(std::string name, std::string description, SystemState state) {
  return {std::move(name), std::move(description),
          [state](S s) { return s.live.status.state == state; }};
}

bool any_stands(const Status& status, int severity) {
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
      in_state("stopped", "Told to stop measuring", SystemState::Stopped),
      {"stale", "The pipeline is silent: the state reads fault and no region's signal is valid",
       [](S s) { return s.stale; }},
      {"process_active",
       "The process runs; while it does not, alarms that ask for it are suppressed",
       [](S s) { return s.live.status.process_active; }},
      {"plc_alive", "plc_heartbeat is watched and has changed in time",
       [](S s) { return s.plc.is_alive; }},
      {"result_available", "A result waits in the result window",
       [](S s) { return s.results.count > 0; }},
      {"result_overrun", "A result was refused because the queue was full; until all are taken",
       [](S s) { return s.results.any_refused; }},
      {"alarm", "An alarm stands at an alarm level",
       [](S s) { return any_stands(s.live.status, 2); }},
      {"warning", "An alarm stands at a warning level, or because its signal is not measured",
       [](S s) { return any_stands(s.live.status, 1); }},
      {"unacknowledged", "An alarm awaits its acknowledgement",
       [](S s) { return any_awaits_acknowledgement(s.live.status); }},
      {"clock_synchronised", "UTC stamps are true: the clock follows a time server",
       [](S s) { return s.live.status.health.clock_synchronised == 1; }},
      {"recipe_refused",
       "A camera refused the settings of the recipe selected last; the one before is measured",
       [](S s) { return s.live.status.recipe_refused; }},
  };
}

std::vector<Bit> make_measurement_bits() {
  std::vector<Bit> bits;
  for (std::size_t i = 0; i < kMaxCameras; ++i) {
    const std::string n = std::to_string(i);
    bits.push_back(
        {"camera_" + n + "_delivers", "Camera " + n + " is configured and has no fault", [i](S s) {
           const Status& status = s.live.status;
           return !s.stale && i < status.camera_count &&
                  status.cameras[i].fault == hal::Fault::None;
         }});
  }
  bits.resize(8);
  for (std::size_t i = 0; i < signals::kMaxRegions; ++i) {
    const std::string n = std::to_string(i);
    bits.push_back({"region_" + n + "_measured", "Region " + n + " has a quality above 0",
                    [i](S s) { return s.live.status.regions[i].quality != Quality::NotMeasured; }});
  }
  for (std::size_t i = 0; i < signals::kMaxRegions; ++i) {
    const std::string n = std::to_string(i);
    bits.push_back({"region_" + n + "_hot_spot", "Region " + n + " has a hot spot", [i](S s) {
                      return s.live.status.regions[i].signals.hot_spot_present > 0;  // not for NaN
                    }});
  }
  return bits;
}

std::vector<Bit> make_process_input_bits() {
  std::vector<Bit> bits;
  for (unsigned i = 0; i < 32; ++i) {
    const std::string n = std::to_string(i);
    bits.push_back({"process_input_" + n, "Process input " + n + " of the configuration is active",
                    [i](S s) { return (s.live.status.process_inputs >> i & 1U) != 0; }});
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
    bits.push_back(
        {numbered("alarm_", i + 1, name), numbered("Alarm ", i + 1, description), [i, is_set](S s) {
           const Status& status = s.live.status;
           return i < status.alarm_count && is_set(status.alarms[i].alarm.state);
         }});
  }
  return bits;
}

/// Of Health::throttling; the other bits remember.
constexpr unsigned kThrottledNow = 0x0f;

bool is_throttled(const Health& health) {
  return signals::is_valid(health.throttling) &&
         (static_cast<unsigned>(health.throttling) & kThrottledNow) != 0;
}

std::vector<Bit> make_fault_bits() {
  std::vector<Bit> bits{
      {"pipeline_silent", "As the discrete input stale", [](S s) { return s.stale; }},
      {"no_camera", "No camera delivers",
       [](S s) { return s.live.status.state == SystemState::Fault && !s.stale; }},
      {"plc_silent", "plc_heartbeat is watched and has not changed in time",
       [](S s) { return s.plc.is_silent; }},
      {"result_overrun", "As the discrete input of that name",
       [](S s) { return s.results.any_refused; }},
      {"late", "A frame set of the last second took longer than its deadline",
       [](S s) { return s.live.status.load > 1; }},
      {"throttled", "The board has under-voltage, or is too hot: it does not work at full speed",
       [](S s) { return is_throttled(s.live.status.health); }},
      {"clock_not_synchronised", "The clock follows no time server: UTC stamps may be wrong",
       [](S s) { return s.live.status.health.clock_synchronised == 0; }},
  };
  bits.resize(8);
  for (std::size_t i = 0; i < kMaxCameras; ++i) {
    const std::string n = std::to_string(i);
    bits.push_back(
        {"camera_" + n, "Camera " + n + " has a fault: see its fault register", [i](S s) {
           const Status& status = s.live.status;
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

std::uint32_t word_of(const std::vector<Bit>& bits, const Snapshot& snapshot) {
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (bits[i].is_set && bits[i].is_set(snapshot)) word |= 1U << i;
  }
  return word;
}

}  // namespace orbwatch::app::modbus
