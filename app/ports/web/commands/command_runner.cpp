// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/commands/command_runner.h"

#include <utility>

#include "app/ports/web/api/record.h"

namespace orbwatch::app::web {
namespace {

int http_status(CommandResult result) {
  switch (result) {
    case CommandResult::Done:
      return 200;
    case CommandResult::UnknownCommand:
      return 404;
    case CommandResult::ArgumentOutOfRange:
      return 400;
    case CommandResult::Busy:
      return 503;
    case CommandResult::NotPossible:
      return 409;
    case CommandResult::Interrupted:
    case CommandResult::NotCarriedOut:
      break;
  }
  return 500;
}

}  // namespace

CommandRunner::CommandRunner(CommandHandler handler, std::shared_ptr<CommandRecord> record)
    : handler_(std::move(handler)), record_(std::move(record)) {
  for (const CommandRecord::Entry& entry : record_->entries()) {
    if (entry.id.client == kClient) number_ = entry.id.number;
  }
}

void CommandRunner::start() {
  thread_.start("web commands", [this] {
    while (thread_.wait()) carry_out_all();
    carry_out_all();  // commands accepted before stop()
  });
}

void CommandRunner::run(const Command& command, const ExchangePtr& exchange, OnResult on_result) {
  if (!handler_) return answer(*exchange, CommandResult::NotPossible);
  if (!waiting_.put({command, exchange, std::move(on_result)})) {
    return answer(*exchange, CommandResult::Busy);
  }
  thread_.wake();
}

void CommandRunner::carry_out_all() {
  while (const auto next = waiting_.try_take()) {
    if (next->exchange->is_answered()) continue;
    // Recording waits for the disk, possibly beyond the request's deadline.
    const auto handle = [&](const Command& command) {
      return next->exchange->begin_effect() ? handler_(command) : CommandResult::NotCarriedOut;
    };
    const CommandResult result =
        record_->carry_out_audited({kClient, ++number_}, next->command, handle);
    next->on_result(result);
    answer(*next->exchange, result);
  }
}

void CommandRunner::answer(Exchange& exchange, CommandResult result) {
  ++(result == CommandResult::Done ? done_ : refused_);
  CommandAnswer answered{result};
  exchange.answer(json_response(json_text(json_of(answered)), http_status(result)));
}

}  // namespace orbwatch::app::web
