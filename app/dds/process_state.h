#pragma once

#include <array>
#include <string>
#include <vector>

#include "app/dds/idl/process_state.h"
#include "app/dds/time_message.h"
#include "app/pipeline/status.h"

namespace orbwatch::app {

using ProcessStateMessage = orbwatch_msgs_msg_dds__ProcessState_;

/// Turns a Status into the message of the process-state topic, in memory that is used again.
/// Thread-bound.
class ProcessStateComposer {
 public:
  /// `view_names` in the order of View::index.
  explicit ProcessStateComposer(std::vector<std::string> view_names)
      : view_names_(std::move(view_names)) {}

  /// The message; valid until the next call. `stamp` is the Status' stamp in UTC.
  const ProcessStateMessage& compose(const Status& status, const TimeMessage& stamp);

 private:
  std::vector<std::string> view_names_;
  std::array<orbwatch_msgs_msg_dds__CameraStatus_, kMaxCameras> cameras_{};
  std::array<orbwatch_msgs_msg_dds__ViewStatus_, kMaxViews> views_{};
  ProcessStateMessage message_{};
};

}  // namespace orbwatch::app
