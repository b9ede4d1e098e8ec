#include "app/cli/dds/state_reader.h"

#include <utility>

#include "app/ports/dds/participant/dds_log.h"
#include "app/ports/dds/topics/topic_names.h"

namespace orbwatch::app {

StateReader::StateReader(const std::string& prefix)
    : states_(orbwatch_msgs_msg_dds__ProcessState__desc, process_state_topic(prefix)) {}

Result<> StateReader::open(int domain, const std::optional<SecuritySettings>& security) {
  limit_dds_log();
  auto participant = Participant::join(domain, security);
  if (!participant) return tl::unexpected(participant.error());
  participant_ = std::move(*participant);
  return states_.open(participant_.entity(), state_qos())
      .and_then([&] { return make_wait_set(participant_.entity(), {states_.get()}); })
      .map([&](Entity wait_set) { wait_set_ = std::move(wait_set); });
}

Result<bool> StateReader::next(std::chrono::nanoseconds timeout, const AcceptState& accept) {
  bool accepted = false;
  // The topic has one instance and a history of one: no more than one sample.
  const auto look = [&](const void* sample, const dds_sample_info_t&) {
    const auto state = check_process_state(*static_cast<const ProcessStateMessage*>(sample));
    if (state) {
      accept(*state);
      accepted = true;
    } else {
      refusal_ = state.error().message;
    }
  };
  const auto taken = wait_for_data(wait_set_, timeout).and_then([&](bool) {
    return take_samples(states_.get(), look);
  });
  if (!taken) return tl::unexpected(taken.error());
  return accepted;
}

}  // namespace orbwatch::app
