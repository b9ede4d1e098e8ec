// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/model/status/status_report.h"
#include "app/ports/dds/participant/time_message.h"
#include "app/ports/dds/status/dds_statistics.h"
#include "app/ports/dds/status/diagnostics.h"
#include "app/ports/dds/status/event_message.h"
#include "app/ports/dds/status/process_state.h"
#include "app/ports/dds/topics/topic_writer.h"
#include "hal/clock.h"

namespace orbwatch::app::dds {

struct StampedStatus {
  Status status;
  TimeMessage stamp;  ///< UTC of the status' stamp; 0: none yet
};
struct StampedNotice {
  AlarmNotice notice;
  TimeMessage stamp;
};

/// All topics except pictures: the process state, events, and ROS' diagnostics once a second.
/// Thread rule: one owner; writers()' statistics by any thread.
class StatusTopics {
 public:
  StatusTopics(const std::string& prefix, StatusNames names);

  Result<> open(const Entity& participant);
  void close();

  void publish(const StampedNotice& stamped);
  /// `network` is called once a second, for the diagnostics.
  void publish(const StampedStatus& stamped, const CommandCounts& commands,
               const std::function<DdsStatistics()>& network);

  std::vector<const TopicWriter*> writers() const { return {&state_, &events_, &diagnostics_}; }

 private:
  const StatusNames names_;
  TopicWriter state_;
  TopicWriter events_;
  TopicWriter diagnostics_;
  ProcessStateComposer state_composer_;
  EventComposer event_composer_;
  DiagnosticsComposer diagnostics_composer_;
  hal::TimePoint next_diagnostics_;
};

}  // namespace orbwatch::app::dds
