#include <algorithm>

#include "app/dds/process_state.h"
#include "app/dds/time_message.h"

namespace orbwatch::app {

namespace {

/// Takes a number over that must be one of an enumeration whose last is `last`.
template <class Enum>
Result<> take_code(std::string_view what, unsigned number, Enum last, Enum& code) {
  if (number > static_cast<unsigned>(last)) {
    return fail("process state: " + std::string(what) + " " + std::to_string(number) + ", 0 to " +
                std::to_string(static_cast<unsigned>(last)) + " are known");
  }
  code = static_cast<Enum>(number);
  return {};
}

/// Takes a list over, entry by entry, if it is not longer than ours.
template <class Sequence, std::size_t N, class Entry, class Take>
Result<> take_list(std::string_view what, const Sequence& sequence, std::array<Entry, N>& entries,
                   std::size_t& count, const Take& take) {
  if (sequence._length > N) {
    return fail("process state: " + std::to_string(sequence._length) + " " + std::string(what) +
                ", at most " + std::to_string(N) + " are possible");
  }
  count = sequence._length;
  for (std::size_t i = 0; i < count; ++i) {
    if (const auto taken = take(sequence._buffer[i], entries[i], i); !taken) return taken;
  }
  return {};
}

Result<> take_region(const orbwatch_msgs_msg_dds__RegionStatus_& message, RegionStatus& region) {
#define ORBWATCH_VALUE(name, unit, scale, minimum, maximum, description) \
  region.signals.name = message.signals.name;
  ORBWATCH_SIGNALS(ORBWATCH_VALUE)
#undef ORBWATCH_VALUE
  return take_code("quality", message.quality, Quality::Apparent, region.quality);
}

Result<> take_alarm(const orbwatch_msgs_msg_dds__AlarmStatus_& message, AlarmStatus& alarm) {
  const auto signal =
      std::ranges::find(signals::kSignals, message.signal, &signals::SignalInfo::name);
  // The sender's text is not repeated: it may hold anything.
  if (signal == signals::kSignals.end()) return fail("process state: alarm of an unknown signal");
  alarm.signal = static_cast<std::size_t>(signal - signals::kSignals.begin());
  alarm.region = message.region;
  alarm.value = message.value;
  alarm.alarm.measurement_lost = message.measurement_lost;
  constexpr auto kLastLevel = signals::AlarmLevel::NoMeasurement;
  return take_code("alarm state", message.state, signals::AlarmState::SuppressedByDesign,
                   alarm.alarm.state)
      .and_then(
          [&] { return take_code("alarm level", message.level, kLastLevel, alarm.alarm.level); })
      .and_then([&] {
        return take_code("alarm level", message.announced, kLastLevel, alarm.alarm.announced);
      });
}

Result<> take_camera(const orbwatch_msgs_msg_dds__CameraStatus_& message, CameraStatus& camera) {
  camera.frames = message.frames;
  camera.lost = message.lost;
  camera.dropped = message.dropped;
  camera.unmatched = message.unmatched;
  camera.frames_per_second = message.frames_per_second;
  camera.latency_p50_ms = message.latency_p50_ms;
  camera.latency_p99_ms = message.latency_p99_ms;
  camera.triggers = message.triggers;
  camera.missed = message.missed;
  return take_code("camera fault", message.fault, hal::Fault::WrongFormat, camera.fault);
}

ViewStatus taken_view(const orbwatch_msgs_msg_dds__ViewStatus_& message) {
  return {message.published,      message.skipped,        message.frames_per_second,
          message.latency_p50_ms, message.latency_p99_ms, message.superseded};
}

Result<> take_measurements(const ProcessStateMessage& message, StatusReport& report) {
  Status& status = report.status;
  auto& region_names = report.names.regions[status.recipe];
  return take_list("regions", message.regions, status.regions, status.region_count,
                   [&](const auto& entry, RegionStatus& region, std::size_t) {
                     region_names.emplace_back(entry.name);
                     return take_region(entry, region);
                   })
      .and_then([&] {
        return take_list("alarms", message.alarms, status.alarms, status.alarm_count,
                         [&](const auto& entry, AlarmStatus& alarm, std::size_t i) {
                           report.times.alarm_age_s[i] = entry.age_s;
                           return take_alarm(entry, alarm);
                         });
      });
}

Result<> take_figures(const ProcessStateMessage& message, StatusReport& report) {
  Status& status = report.status;
  return take_list("cameras", message.cameras, status.cameras, status.camera_count,
                   [&](const auto& entry, CameraStatus& camera, std::size_t i) {
                     report.names.cameras.emplace_back(entry.name);
                     report.times.last_frame_age_s[i] = entry.last_frame_age_s;
                     return take_camera(entry, camera);
                   })
      .and_then([&] {
        return take_list("views", message.views, status.views, status.view_count,
                         [&](const auto& entry, ViewStatus& view, std::size_t) -> Result<> {
                           report.names.views.emplace_back(entry.name);
                           view = taken_view(entry);
                           return {};
                         });
      });
}

Health taken_health(const orbwatch_msgs_msg_dds__Health_& message) {
  return {
#define ORBWATCH_VALUE(name, unit, scale, minimum, maximum, description) message.name,
      ORBWATCH_HEALTH(ORBWATCH_VALUE)
#undef ORBWATCH_VALUE
  };
}

}  // namespace

Result<ReceivedState> check_process_state(const ProcessStateMessage& message) {
  ReceivedState state;
  Status& status = state.report.status;
  status.frame_set = message.frame_set;
  status.trigger = message.trigger;
  status.result = message.result;
  status.recipe = message.recipe;
  status.configuration_checksum = message.configuration_checksum;
  status.recipe_refused = message.recipe_refused;
  status.process_active = message.process_active;
  status.heartbeat = message.heartbeat;
  status.selected_view = message.selected_view;
  status.process_inputs = message.process_inputs;
  status.overruns = message.overruns;
  status.unmatched = message.unmatched;
  status.skew_ms = message.skew_ms;
  status.load = message.load;
  status.health = taken_health(message.health);
  state.report.times.stamp = to_utc(message.stamp);
  state.commands = {message.commands.done, message.commands.refused, message.commands.repeated,
                    message.commands.dropped};
  const auto taken =
      take_code("system state", message.system_state, SystemState::Stopped, status.state)
          .and_then([&] { return take_measurements(message, state.report); })
          .and_then([&] { return take_figures(message, state.report); });
  if (!taken) return tl::unexpected(taken.error());
  return state;
}

}  // namespace orbwatch::app
