#include "app/dds/process_state.h"

#include <algorithm>

#include "app/dds/time_message.h"

namespace orbwatch::app {

namespace {

/// The C API takes no const pointers, but a write changes nothing.
char* text(std::string_view zero_terminated) { return const_cast<char*>(zero_terminated.data()); }

char* name_at(const std::vector<std::string>& names, std::size_t index) {
  return index < names.size() ? text(names[index]) : text("");
}

orbwatch_msgs_msg_dds__RegionStatus_ region_message(const RegionStatus& region, char* name) {
  return {name,
          static_cast<std::uint8_t>(region.quality),
          {
#define ORBWATCH_VALUE(name, unit, scale, minimum, maximum, description) region.signals.name,
              ORBWATCH_SIGNALS(ORBWATCH_VALUE)
#undef ORBWATCH_VALUE
          }};
}

orbwatch_msgs_msg_dds__AlarmStatus_ alarm_message(const AlarmStatus& alarm, double age_s) {
  return {static_cast<std::uint32_t>(alarm.region),
          text(signals::kSignals[std::min(alarm.signal, signals::kSignals.size() - 1)].name),
          static_cast<std::uint8_t>(alarm.alarm.state),
          static_cast<std::uint8_t>(alarm.alarm.level),
          static_cast<std::uint8_t>(alarm.alarm.announced),
          alarm.alarm.measurement_lost,
          alarm.value,
          age_s};
}

orbwatch_msgs_msg_dds__CameraStatus_ camera_message(const CameraStatus& camera, char* name,
                                                    double last_frame_age_s) {
  return {name,
          static_cast<std::uint8_t>(camera.fault),
          camera.frames,
          camera.lost,
          camera.dropped,
          camera.frames_per_second,
          camera.latency_p50_ms,
          camera.latency_p99_ms,
          camera.triggers,
          camera.missed,
          camera.unmatched,
          last_frame_age_s};
}

orbwatch_msgs_msg_dds__ViewStatus_ view_message(const ViewStatus& view, char* name) {
  return {name,
          view.published,
          view.skipped,
          view.frames_per_second,
          view.latency_p50_ms,
          view.latency_p99_ms,
          view.superseded};
}

orbwatch_msgs_msg_dds__Health_ health_message(const Health& health) {
  return {
#define ORBWATCH_VALUE(name, unit, scale, minimum, maximum, description) health.name,
      ORBWATCH_HEALTH(ORBWATCH_VALUE)
#undef ORBWATCH_VALUE
  };
}

/// Makes the first `count` entries of the array that is kept, and has the message's list lead
/// there.
template <class Sequence, class Entry, std::size_t N, class Make>
void fill(Sequence& sequence, std::array<Entry, N>& entries, std::size_t count, const Make& make) {
  count = std::min(count, N);
  for (std::size_t i = 0; i < count; ++i) entries[i] = make(i);
  sequence = {N, static_cast<std::uint32_t>(count), entries.data(), false};
}

}  // namespace

ProcessStateComposer::ProcessStateComposer(StatusNames names) : names_(std::move(names)) {}

const ProcessStateMessage& ProcessStateComposer::compose(const Status& status,
                                                         const StatusTimes& times,
                                                         const CommandCounts& commands) {
  message_.stamp = to_message(times.stamp);
  message_.frame_set = status.frame_set;
  message_.trigger = status.trigger;
  message_.result = status.result;
  message_.recipe = status.recipe;
  message_.configuration_checksum = status.configuration_checksum;
  message_.recipe_refused = status.recipe_refused;
  message_.process_active = status.process_active;
  message_.system_state = static_cast<std::uint8_t>(status.state);
  message_.heartbeat = status.heartbeat;
  message_.selected_view = static_cast<std::uint32_t>(status.selected_view);
  message_.process_inputs = status.process_inputs;
  message_.overruns = status.overruns;
  message_.unmatched = status.unmatched;
  message_.skew_ms = status.skew_ms;
  message_.load = status.load;
  compose_lists(status, times);
  message_.health = health_message(status.health);
  message_.commands = {commands.done, commands.refused, commands.repeated, commands.dropped};
  return message_;
}

void ProcessStateComposer::compose_lists(const Status& status, const StatusTimes& times) {
  fill(message_.regions, regions_, status.region_count, [&](std::size_t i) {
    const std::string_view name = names_.region(status.recipe, i);
    return region_message(status.regions[i], name.empty() ? text("") : text(name));
  });
  fill(message_.alarms, alarms_, status.alarm_count,
       [&](std::size_t i) { return alarm_message(status.alarms[i], times.alarm_age_s[i]); });
  fill(message_.cameras, cameras_, status.camera_count, [&](std::size_t i) {
    return camera_message(status.cameras[i], name_at(names_.cameras, i), times.last_frame_age_s[i]);
  });
  fill(message_.views, views_, status.view_count,
       [&](std::size_t i) { return view_message(status.views[i], name_at(names_.views, i)); });
}

}  // namespace orbwatch::app
