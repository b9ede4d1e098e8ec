#include "app/dds/command_service.h"

#include "app/dds/samples.h"
#include "app/dds/topic_names.h"

namespace orbwatch::app {

CommandService::CommandService(const std::string& prefix, CommandHandler handler)
    : handler_(std::move(handler)),
      requests_(orbwatch_msgs_msg_dds__Command__desc, command_topic(prefix)),
      results_(orbwatch_msgs_msg_dds__CommandResult__desc, command_result_topic(prefix)) {}

CommandService::~CommandService() { close(); }

Result<> CommandService::open(const Entity& participant) {
  // The way of the answers first: whoever finds the reader may ask at once.
  if (const auto opened = results_.open(participant, command_qos()); !opened) return opened;
  show_order_of_calls();
  const Listener listener(dds_create_listener(this));
  dds_lset_data_available(listener.get(), receive);
  const auto opened = requests_.open(participant, command_qos(), listener.get());
  if (!opened) return opened;
  running_ = true;
  thread_ = std::thread([this] { run(); });
  return {};
}

void CommandService::close() {
  requests_.close();
  show_order_of_calls();
  running_ = false;
  wake_.ring();
  if (thread_.joinable()) thread_.join();
  results_.close();
}

void CommandService::receive(dds_entity_t reader, void* service) {
  auto& self = *static_cast<CommandService*>(service);
  show_order_of_calls();
  const auto take = [&self](const void* sample, const dds_sample_info_t&) {
    self.queue_.put(request_of(*static_cast<const CommandMessage*>(sample)));
  };
  // Refused only when the reader is being deleted: then there is nobody left to serve.
  for (auto taken = take_samples(reader, take); taken && *taken > 0;) {
    taken = take_samples(reader, take);
  }
  self.wake_.ring();
  show_order_of_calls();
}

void CommandService::run() {
  // What came in before close() is still carried out.
  for (bool last = false; !last;) {
    wake_.wait();
    last = !running_;
    while (const auto request = queue_.try_take()) serve(*request);
  }
}

void CommandService::serve(const CommandRequest& request) {
  const auto verdict = ledger_.judge(request.id);
  if (verdict == RequestLedger::Verdict::New) {
    ledger_.note(request.id, answer_new(request));
  } else {
    ++repeated_;
  }
  // A late one was answered before; only its client's newest can still be waited for.
  if (verdict != RequestLedger::Verdict::Late) send(request.id, ledger_.answer(request.id));
}

CommandAnswer CommandService::answer_new(const CommandRequest& request) {
  CommandAnswer answer{CommandResult::Busy, "more than " + std::to_string(kMaxPerSecond) +
                                                " commands in a second: try again"};
  if (rate_.admit(hal::Clock::now())) answer = carry_out(request, handler_);
  ++(answer.result == CommandResult::Done ? done_ : refused_);
  return answer;
}

void CommandService::send(const RequestId& id, const CommandAnswer& answer) {
  // The C API takes no const pointers, but a write changes nothing.
  const CommandResultMessage message{id.client, id.number,
                                     static_cast<std::uint16_t>(answer.result),
                                     const_cast<char*>(answer.text.c_str())};
  results_.write(&message);
}

CommandCounts CommandService::counts() const {
  return {done_, refused_, repeated_, queue_.drops()};
}

}  // namespace orbwatch::app
