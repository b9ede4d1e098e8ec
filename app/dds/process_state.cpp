#include "app/dds/process_state.h"

#include <algorithm>

namespace orbwatch::app {

namespace {

orbwatch_msgs_msg_dds__CameraStatus_ camera_message(const CameraStatus& camera) {
  return {static_cast<std::uint8_t>(camera.fault),
          camera.frames,
          camera.lost,
          camera.dropped,
          camera.frames_per_second,
          camera.latency_p50_ms,
          camera.latency_p99_ms,
          camera.triggers,
          camera.missed,
          camera.unmatched};
}

orbwatch_msgs_msg_dds__ViewStatus_ view_message(const ViewStatus& view, std::string& name) {
  return {name.data(),         view.published,     view.skipped, view.frames_per_second,
          view.latency_p50_ms, view.latency_p99_ms};
}

orbwatch_msgs_msg_dds__Signals_ signals_message(const signals::Signals& signals) {
  return {
#define ORBWATCH_VALUE(name, unit, scale, minimum, maximum, description) signals.name,
      ORBWATCH_SIGNALS(ORBWATCH_VALUE)
#undef ORBWATCH_VALUE
  };
}

}  // namespace

const ProcessStateMessage& ProcessStateComposer::compose(const Status& status,
                                                         const TimeMessage& stamp) {
  const std::size_t cameras = std::min(status.camera_count, kMaxCameras);
  for (std::size_t i = 0; i < cameras; ++i) cameras_[i] = camera_message(status.cameras[i]);
  const std::size_t views = std::min({status.view_count, kMaxViews, view_names_.size()});
  for (std::size_t i = 0; i < views; ++i) views_[i] = view_message(status.views[i], view_names_[i]);

  message_.stamp = stamp;
  message_.frame_set = status.frame_set;
  message_.trigger = status.trigger;
  message_.system_state = static_cast<std::uint8_t>(status.state);
  message_.heartbeat = status.heartbeat;
  message_.selected_view = static_cast<std::uint32_t>(status.selected_view);
  message_.process_inputs = status.process_inputs;
  message_.overruns = status.overruns;
  message_.unmatched = status.unmatched;
  message_.skew_ms = status.skew_ms;
  message_.load = status.load;
  message_.signals = signals_message(status.signals);
  message_.cameras = {kMaxCameras, static_cast<std::uint32_t>(cameras), cameras_.data(), false};
  message_.views = {kMaxViews, static_cast<std::uint32_t>(views), views_.data(), false};
  return message_;
}

}  // namespace orbwatch::app
