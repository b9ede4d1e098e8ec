// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>

#include "app/model/command/command.h"
#include "app/ports/web/http/exchange.h"
#include "app/state/command_record.h"
#include "hal/thread/bounded_queue.h"
#include "hal/thread/thread.h"

namespace orbwatch::app::web {

/// Answer to a command.
struct CommandAnswer {
  CommandResult result = CommandResult::Done;
};
template <class Visitor>
void visit(Visitor& v, CommandAnswer& answer) {
  v.required("result", answer.result, "0: done; else the reason of the refusal");
}

/// Executes commands one after the other on a separate thread, because it waits for the disk, and
/// answers their requests. A command whose request was answered by its deadline is not executed;
/// once its handler has begun, its result is the answer, however late.
/// Thread rule: start and stop by one owner; everything else on any thread.
class CommandRunner {
 public:
  /// Limit of waiting commands; further ones are refused as busy.
  static constexpr std::size_t kMostWaiting = 16;
  /// Client number in the record: all requests over HTTP are one client. Spells "web".
  static constexpr std::uint64_t kClient = 0x776562;

  using OnResult = std::function<void(CommandResult)>;

  /// Without a handler every command is refused as not possible.
  CommandRunner(CommandHandler handler, std::shared_ptr<CommandRecord> record);

  void start();
  /// Executes waiting commands, then stops.
  void stop() { thread_.stop(); }

  /// `on_result` audits the command: it is called before the answer, on the runner's thread, unless
  /// the command was refused as busy.
  void run(const Command& command, const ExchangePtr& exchange, OnResult on_result);

  std::uint64_t done() const { return done_; }
  std::uint64_t refused() const { return refused_; }
  std::chrono::nanoseconds cpu_time() const { return thread_.cpu_time(); }

 private:
  struct Waiting {
    Command command;
    ExchangePtr exchange;
    OnResult on_result;
  };

  void carry_out_all();
  void answer(Exchange& exchange, CommandResult result);

  const CommandHandler handler_;
  const std::shared_ptr<CommandRecord> record_;
  std::uint64_t number_ = 0;  ///< number of the newest command; used by the thread only
  hal::BoundedQueue<Waiting, kMostWaiting> waiting_;
  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::uint64_t> refused_{0};
  hal::Thread thread_;
};

}  // namespace orbwatch::app::web
