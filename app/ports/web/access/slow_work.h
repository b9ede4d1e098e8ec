#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>

#include "app/ports/web/http/exchange.h"
#include "hal/thread/thread.h"

namespace orbwatch::app::web {

/// Answers requests that wait for a hash of a password, for a check of a whole configuration or for
/// the disk, one after the other on a thread of its own in the background, so that a flood of them
/// takes one core's spare time and no more memory than one of them. Thread rule: start and stop by
/// one owner; run on any thread.
class SlowWork {
 public:
  /// One more is refused with 503.
  static constexpr std::size_t kMostWaiting = 8;

  /// `thread` is its name; `busy` says why one more is refused. Both are kept as they are.
  SlowWork(const char* thread, const char* busy) : thread_name_(thread), busy_(busy) {}

  void start();
  void stop() { thread_.stop(); }

  /// `work` makes the answer. It is not begun when the request was answered by its deadline; once
  /// begun its answer is given, however late.
  void run(const ExchangePtr& exchange, std::function<Response()> work);

  std::chrono::nanoseconds cpu_time() const { return thread_.cpu_time(); }

 private:
  struct Waiting {
    ExchangePtr exchange;
    std::function<Response()> work;
  };

  void work_all();

  const char* const thread_name_;
  const char* const busy_;
  std::mutex mutex_;
  std::deque<Waiting> waiting_;  ///< under mutex_
  hal::Thread thread_;
};

}  // namespace orbwatch::app::web
