#pragma once

#include <array>
#include <string>

#include "app/dds/command_counts.h"
#include "app/dds/idl/process_state.h"
#include "app/pipeline/status_report.h"
#include "proc/image/result.h"

namespace orbwatch::app {

using ProcessStateMessage = orbwatch_msgs_msg_dds__ProcessState_;

/// Turns a status into the message of the process-state topic, in memory that is used again.
/// Thread-bound.
class ProcessStateComposer {
 public:
  explicit ProcessStateComposer(StatusNames names);

  /// The message; valid until the next call.
  const ProcessStateMessage& compose(const Status& status, const StatusTimes& times,
                                     const CommandCounts& commands);

 private:
  void compose_lists(const Status& status, const StatusTimes& times);

  StatusNames names_;
  std::array<orbwatch_msgs_msg_dds__RegionStatus_, signals::kMaxRegions> regions_{};
  std::array<orbwatch_msgs_msg_dds__AlarmStatus_, signals::kMaxAlarms> alarms_{};
  std::array<orbwatch_msgs_msg_dds__CameraStatus_, kMaxCameras> cameras_{};
  std::array<orbwatch_msgs_msg_dds__ViewStatus_, kMaxViews> views_{};
  ProcessStateMessage message_{};
};

/// A process state that came over DDS.
struct ReceivedState {
  StatusReport report;
  CommandCounts commands;
};

/// Checks a message from the network and takes everything over. Errors: lists that are longer than
/// ours, numbers that no list of ours has, signals that we do not know. Reentrant.
Result<ReceivedState> check_process_state(const ProcessStateMessage& message);

}  // namespace orbwatch::app
