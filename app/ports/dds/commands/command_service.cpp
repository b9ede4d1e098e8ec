// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/commands/command_service.h"

#include "app/ports/dds/topics/topic_names.h"

namespace orbwatch::app::dds {

CommandService::CommandService(const std::string& prefix, CommandHandler handler,
                               CommandRecord& record)
    : handler_(std::move(handler)),
      record_(record),
      requests_(orbwatch_msgs_msg_dds__Command__desc, command_topic(prefix)),
      results_(orbwatch_msgs_msg_dds__CommandResult__desc, command_result_topic(prefix)) {
  for (const CommandRecord::Entry& entry : record.entries()) {
    if (entry.id.client == kPlcClient) continue;
    ledger_.record(entry.id, {entry.result, std::string(operator_text(entry.result))});
  }
}

CommandService::~CommandService() { close(); }

Result<> CommandService::open(const Entity& participant) {
  // Opens the answers first, because a client may send as soon as it discovers the reader.
  if (const auto opened = results_.open(participant, command_qos()); !opened) return opened;
  thread_.start("dds commands", [this] {
    while (thread_.wait()) serve_all();
  });
  show_order_of_calls();
  const Listener listener(dds_create_listener(this));
  dds_lset_data_available(listener.get(), receive);
  return requests_.open(participant, command_qos(), listener.get());
}

void CommandService::close() {
  requests_.close();
  show_order_of_calls();
  thread_.stop();
  serve_all();
  results_.close();
}

void CommandService::receive(dds_entity_t reader, void* service) {
  auto& self = *static_cast<CommandService*>(service);
  show_order_of_calls();
  const auto take = [&self](const void* sample, const dds_sample_info_t&) {
    self.queue_.put(request_of(*static_cast<const CommandMessage*>(sample)));
  };
  take_all_samples(reader, take);
  self.thread_.wake();
  show_order_of_calls();
}

void CommandService::serve_all() {
  while (const auto request = queue_.try_take()) serve(*request);
}

void CommandService::serve(const CommandRequest& request) {
  const auto verdict = ledger_.judge(request.id);
  if (verdict == RequestLedger::Verdict::New) {
    ledger_.record(request.id, answer_new(request));
  } else {
    ++repeated_;
  }
  // A client waits only for the answer to its newest request.
  if (verdict != RequestLedger::Verdict::Late) send(request.id, ledger_.answer(request.id));
}

CommandAnswer CommandService::answer_new(const CommandRequest& request) {
  CommandAnswer answer{CommandResult::Busy, "more than " + std::to_string(kMaxPerSecond) +
                                                " commands in a second: try again"};
  if (rate_.admit(hal::Clock::now())) {
    answer = carry_out(request, [&](const Command& command) {
      return record_.carry_out(request.id, command, handler_);
    });
  }
  ++(answer.result == CommandResult::Done ? done_ : refused_);
  return answer;
}

void CommandService::send(const RequestId& id, const CommandAnswer& answer) {
  // The C API takes non-const pointers, but a write changes nothing.
  const CommandResultMessage message{id.client, id.number,
                                     static_cast<std::uint16_t>(answer.result),
                                     const_cast<char*>(answer.text.c_str())};
  results_.write(&message);
}

CommandCounts CommandService::counts() const {
  return {done_, refused_, repeated_, queue_.drops()};
}

}  // namespace orbwatch::app::dds
