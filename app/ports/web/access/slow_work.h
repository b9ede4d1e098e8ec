#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <string>

#include "app/ports/web/http/exchange.h"
#include "hal/thread/thread.h"

namespace orbwatch::app::web {

/// Answers requests that wait for a hash of a password, for a check of a whole configuration or for
/// the disk, one after the other on a thread of its own in the background, so that a flood of them
/// takes one core's spare time and no more memory than one of them. Known and unknown clients have
/// a queue each, served in turn: neither can keep the other out. Thread rule: start and stop by one
/// owner; run on any thread.
class SlowWork {
 public:
  /// Limit of each queue; one more is refused with 503.
  static constexpr std::size_t kMostWaiting = 8;
  /// Limits of one asker in its queue.
  static constexpr std::size_t kMostOfKnown = 4;
  static constexpr std::size_t kMostOfUnknown = 2;

  /// A client that waits.
  struct Asker {
    bool is_known = false;  ///< has a role, or asks from where the user has logged in before
    std::string key;        ///< a name or an address
  };

  /// `thread` is its name; `busy` says why one more is refused. Both are kept as they are.
  SlowWork(const char* thread, const char* busy) : thread_name_(thread), busy_(busy) {}

  void start();
  void stop() { thread_.stop(); }

  /// `work` makes the answer. It is not begun when the request was answered by its deadline; once
  /// begun its answer is given, however late.
  void run(const ExchangePtr& exchange, const Asker& asker, std::function<Response()> work);

  std::chrono::nanoseconds cpu_time() const { return thread_.cpu_time(); }

 private:
  struct Waiting {
    std::string key;
    ExchangePtr exchange;
    std::function<Response()> work;
  };
  using Queue = std::deque<Waiting>;

  void work_all();
  Queue& next_queue();  ///< empty: nobody waits; under mutex_

  const char* const thread_name_;
  const char* const busy_;
  std::mutex mutex_;
  Queue known_, unknown_;   ///< under mutex_
  bool was_known_ = false;  ///< the newest that was served; under mutex_
  hal::Thread thread_;
};

}  // namespace orbwatch::app::web
