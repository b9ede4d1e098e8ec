#pragma once

#include <functional>
#include <string>
#include <vector>

#include "app/dds/dds_statistics.h"
#include "app/dds/process_state.h"
#include "app/dds/ros/diagnostics.h"
#include "app/dds/time_message.h"
#include "app/dds/topic_writer.h"
#include "app/pipeline/status_names.h"
#include "hal/clock.h"

namespace orbwatch::app {

struct StampedStatus {
  Status status;
  TimeMessage stamp;  ///< UTC of the status' stamp
};
struct StampedNotice {
  AlarmNotice notice;
  TimeMessage stamp;
};

/// The topics of what is known beside the pictures: the process state, what happens to alarms, and
/// ROS' diagnostics once a second.
/// Thread rule: one owner; writers()' statistics by any thread.
class StatusTopics {
 public:
  StatusTopics(const std::string& prefix, StatusNames names);

  Result<> open(const Entity& participant);
  void close();

  void publish(const StampedNotice& stamped);
  /// `network` is asked once a second, for the diagnostics.
  void publish(const StampedStatus& stamped, const CommandCounts& commands,
               const std::function<DdsStatistics()>& network);

  std::vector<const TopicWriter*> writers() const { return {&state_, &events_, &diagnostics_}; }

 private:
  void diagnose(const StatusReport& report, const DdsStatistics& network, hal::TimePoint now);

  const StatusNames names_;
  TopicWriter state_;
  TopicWriter events_;
  TopicWriter diagnostics_;
  ProcessStateComposer state_composer_;
  DiagnosticsComposer diagnostics_composer_;
  hal::TimePoint next_diagnostics_;
};

}  // namespace orbwatch::app
