// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/status/status_topics.h"

#include <chrono>

#include "app/ports/dds/topics/topic_names.h"
#include "hal/host.h"

namespace orbwatch::app::dds {
namespace {

constexpr auto kDiagnosticsPeriod = std::chrono::seconds(1);

}  // namespace

StatusTopics::StatusTopics(const std::string& prefix, StatusNames names)
    : names_(std::move(names)),
      state_(orbwatch_msgs_msg_dds__ProcessState__desc, process_state_topic(prefix)),
      events_(orbwatch_msgs_msg_dds__Event__desc, event_topic(prefix)),
      diagnostics_(diagnostic_msgs_msg_dds__DiagnosticArray__desc, kDiagnosticsTopic),
      diagnostics_composer_(hal::host_name()) {}

Result<> StatusTopics::open(const Entity& participant) {
  return state_.open(participant, process_state_qos())
      .and_then([&] { return events_.open(participant, event_qos()); })
      .and_then([&] { return diagnostics_.open(participant, frame_qos()); });
}

void StatusTopics::close() {
  state_.close();
  events_.close();
  diagnostics_.close();
}

void StatusTopics::publish(const StampedNotice& stamped) {
  events_.write(&event_composer_.compose(stamped.notice, names_, stamped.stamp));
}

void StatusTopics::publish(const StampedStatus& stamped, const CommandCounts& commands,
                           const std::function<DdsStatistics()>& network) {
  const auto now = hal::Clock::now();
  const StatusReport report{stamped.status, names_, now, to_utc(stamped.stamp)};
  state_.write(&state_composer_.compose(report, commands));
  if (now < next_diagnostics_) return;
  next_diagnostics_ = now + kDiagnosticsPeriod;
  if (diagnostics_.has_reader()) {
    diagnostics_.write(
        &diagnostics_composer_.compose(diagnose(report, network()), to_message(hal::to_utc(now))));
  } else {
    diagnostics_.count_unread();
  }
}

}  // namespace orbwatch::app::dds
