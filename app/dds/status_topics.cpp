#include "app/dds/status_topics.h"

#include <unistd.h>

#include <array>
#include <chrono>

#include "app/dds/alarm_event.h"
#include "app/dds/network_diagnostic.h"
#include "app/dds/topic_names.h"

namespace orbwatch::app {
namespace {

constexpr auto kDiagnosticsPeriod = std::chrono::seconds(1);

/// Empty when the system does not say.
std::string host_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0) return {};
  return name.data();
}

}  // namespace

StatusTopics::StatusTopics(const std::string& prefix, StatusNames names)
    : names_(std::move(names)),
      state_(orbwatch_msgs_msg_dds__ProcessState__desc, process_state_topic(prefix)),
      events_(orbwatch_msgs_msg_dds__AlarmEvent__desc, event_topic(prefix)),
      diagnostics_(diagnostic_msgs_msg_dds__DiagnosticArray__desc, kDiagnosticsTopic),
      state_composer_(names_),
      diagnostics_composer_(host_name()) {}

Result<> StatusTopics::open(const Entity& participant) {
  return state_.open(participant, state_qos())
      .and_then([&] { return events_.open(participant, event_qos()); })
      .and_then([&] { return diagnostics_.open(participant, frame_qos()); });
}

void StatusTopics::close() {
  state_.close();
  events_.close();
  diagnostics_.close();
}

void StatusTopics::publish(const StampedNotice& stamped) {
  std::string text = notice_text(stamped.notice, names_);
  const AlarmEventMessage message = event_message(stamped.notice, stamped.stamp, text);
  events_.write(&message);
}

void StatusTopics::publish(const StampedStatus& stamped, const CommandCounts& commands,
                           const std::function<DdsStatistics()>& network) {
  const auto now = hal::Clock::now();
  const StatusTimes times = times_of(stamped.status, to_utc(stamped.stamp), now);
  state_.write(&state_composer_.compose(stamped.status, times, commands));
  if (now < next_diagnostics_) return;
  next_diagnostics_ = now + kDiagnosticsPeriod;
  if (diagnostics_.has_reader()) {
    diagnose({stamped.status, names_, times}, network(), now);
  } else {
    diagnostics_.count_unread();
  }
}

void StatusTopics::diagnose(const StatusReport& report, const DdsStatistics& network,
                            hal::TimePoint now) {
  std::vector<Diagnostic> diagnostics = app::diagnose(report, network.commands);
  diagnostics.push_back(diagnose_network(network));
  diagnostics_.write(
      &diagnostics_composer_.compose(std::move(diagnostics), to_message(hal::to_utc(now))));
}

}  // namespace orbwatch::app
