#pragma once

#include <atomic>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>

#include "app/model/command.h"
#include "app/ports/web/http/exchange.h"
#include "app/state/command_record.h"
#include "hal/thread/thread.h"

namespace orbwatch::app::web {

/// Carries commands out one after the other on a thread of its own, since that waits for the disk,
/// and answers their requests. One whose request was answered by its deadline is not carried out;
/// once its handler has begun, its result is the answer, however late.
/// Thread rule: start and stop by one owner; the rest on any thread.
class CommandRunner {
 public:
  /// One more is refused as busy.
  static constexpr std::size_t kMostWaiting = 16;
  /// Behind which the record finds them: all requests over HTTP are one client. Spells "web".
  static constexpr std::uint64_t kClient = 0x776562;

  using OnResult = std::function<void(CommandResult)>;

  /// Without a handler every command is refused as not possible.
  CommandRunner(CommandHandler handler, std::shared_ptr<CommandRecord> record);

  void start();
  /// Carries out what waits.
  void stop() { thread_.stop(); }

  /// `on_result` is called before the answer, on the runner's thread, unless the command was
  /// refused because of too many.
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
  std::uint64_t number_ = 0;  ///< of the newest command; the thread's
  std::mutex mutex_;
  std::deque<Waiting> waiting_;  ///< under mutex_
  std::atomic<std::uint64_t> done_{0};
  std::atomic<std::uint64_t> refused_{0};
  hal::Thread thread_;
};

}  // namespace orbwatch::app::web
