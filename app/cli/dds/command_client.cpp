// SPDX-License-Identifier: Apache-2.0
#include "app/cli/dds/command_client.h"

#include <algorithm>
#include <random>
#include <utility>

#include "app/ports/dds/participant/dds_log.h"
#include "app/ports/dds/participant/participant.h"
#include "app/ports/dds/topics/topic_names.h"
#include "app/ports/dds/topics/topic_reader.h"
#include "app/ports/dds/topics/topic_writer.h"
#include "hal/clock.h"

namespace orbwatch::app::cli {

namespace {

using std::chrono::milliseconds;

/// Period in which `cancelled` is checked.
constexpr milliseconds kPollPeriod{100};
/// Period of the repetition: an answer is lost while orbwatchd has not discovered our reader yet.
constexpr milliseconds kRepeatPeriod{500};

/// Random id, never 0; collisions are improbable.
std::uint64_t random_client() {
  std::random_device random;
  return std::uint64_t{random()} << 32 | random() | 1;
}

/// One request, with the topics of requests and answers.
class Exchange {
 public:
  Exchange(const std::string& prefix, const Command& command)
      : command_(command),
        info_(*find_command(command.code)),
        requests_(orbwatch_msgs_msg_dds__Command__desc, dds::command_topic(prefix)),
        answers_(orbwatch_msgs_msg_dds__CommandResult__desc, dds::command_result_topic(prefix)) {}

  Result<> open(int domain, const std::optional<dds::SecuritySettings>& security) {
    auto participant = dds::Participant::join(domain, security);
    if (!participant) return tl::unexpected(participant.error());
    participant_ = std::move(*participant);
    const dds::Entity& entity = participant_.entity();
    return answers_.open(entity, dds::command_qos())
        .and_then([&] { return requests_.open(entity, dds::command_qos()); })
        .and_then([&] { return make_wait_set(entity, {answers_.get()}); })
        .map([&](dds::Entity wait_set) { wait_set_ = std::move(wait_set); });
  }

  /// Makes the same command another request.
  void renew() { ++id_.number; }

  bool has_reader() const { return requests_.has_reader(); }

  void send() {
    const auto count = static_cast<std::uint32_t>(info_.argument_count());
    // The C API has no const pointers, but a write changes nothing.
    const dds::CommandMessage message{id_.client,
                                      id_.number,
                                      const_cast<char*>(info_.name.data()),
                                      {count, count, command_.arguments.data(), false}};
    requests_.write(&message);
  }

  /// Receives the answer, if it arrives within `timeout`.
  Result<std::optional<dds::CommandAnswer>> receive(std::chrono::nanoseconds timeout) {
    std::optional<dds::CommandAnswer> answer;
    const auto look = [&](const void* sample, const dds_sample_info_t&) {
      const auto& message = *static_cast<const dds::CommandResultMessage*>(sample);
      const dds::RequestId answered{message.client, message.number};
      if (answered == id_) answer = {static_cast<CommandResult>(message.result), message.text};
    };
    return wait_for_data(wait_set_, timeout)
        .and_then([&](bool) { return dds::take_samples(answers_.get(), look); })
        .map([&](std::size_t) { return answer; });
  }

 private:
  dds::RequestId id_{random_client(), 1};
  Command command_;
  const CommandInfo& info_;
  dds::Participant participant_;
  dds::TopicWriter requests_;
  dds::TopicReader answers_;
  dds::Entity wait_set_;
};

Result<dds::CommandAnswer> checked(dds::CommandAnswer answer) {
  if (!operator_text(answer.result).empty()) return answer;
  return fail("DDS: result " + std::to_string(static_cast<int>(answer.result)) +
              " of the command is unknown");
}

}  // namespace

Result<dds::CommandAnswer> send_command(const CommandOptions& options, const Command& command,
                                        const std::atomic<bool>& cancelled) {
  dds::limit_dds_log();
  Exchange exchange(options.prefix, command);
  if (const auto opened = exchange.open(options.domain, options.security); !opened) {
    return tl::unexpected(opened.error());
  }
  const hal::TimePoint end = hal::Clock::now() + options.timeout;
  std::optional<hal::TimePoint> sent;
  int times_sent = 0;
  for (auto now = hal::Clock::now(); now < end && !cancelled; now = hal::Clock::now()) {
    if (exchange.has_reader() && (!sent || now - *sent >= kRepeatPeriod)) {
      exchange.send();
      sent = now;
      ++times_sent;
    }
    auto answer = exchange.receive(std::min<hal::Clock::duration>(kPollPeriod, end - now));
    if (!answer) return tl::unexpected(answer.error());
    // An orbwatchd without a record cannot tell whether a previous one executed the request. A
    // request that was sent only once was received by this one alone.
    if (*answer && (*answer)->result == CommandResult::NotCarriedOut && times_sent == 1) {
      exchange.renew();
      sent.reset();
      continue;
    }
    if (*answer) return checked(std::move(**answer));
  }
  if (cancelled) return fail("DDS: cancelled; the command may have been carried out or not");
  return fail(sent ? "DDS: no answer in time; the command may have been carried out or not"
                   : "DDS: nobody accepts commands on " + dds::command_topic(options.prefix) +
                         "; does orbwatchd run in this domain, with commands enabled?");
}

}  // namespace orbwatch::app::cli
