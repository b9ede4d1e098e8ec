// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "app/ports/web/http/exchange.h"
#include "hal/thread/bounded_queue.h"
#include "hal/thread/thread.h"

namespace orbwatch::app::web {

/// Answers requests that wait for a hash of a password, for a check of a whole configuration or for
/// the disk, one after the other on a separate background thread, so that a flood of them uses at
/// most one core's idle time and the memory of one. Known and unknown clients have separate queues,
/// served alternately, so that neither can lock the other out. Thread rule: start and stop by one
/// owner; run on any thread.
class SlowWork {
 public:
  /// Limit of each queue; a further request is refused with 503.
  static constexpr std::size_t kMostWaiting = 8;
  /// Usual limits of one client in its queue.
  static constexpr std::size_t kMostOfKnown = 4;
  static constexpr std::size_t kMostOfUnknown = 2;

  /// A waiting client.
  struct Asker {
    /// Has a role, or comes from an address from which the user has logged in before.
    bool is_known = false;
    std::string key;  ///< name or address
  };

  /// `thread` is its name; `busy` is the reason with which further requests are refused. Both are
  /// stored as pointers. `most_of_known`: limit of one known client.
  SlowWork(const char* thread, const char* busy, std::size_t most_of_known = kMostOfKnown)
      : thread_name_(thread), busy_(busy), most_of_known_(most_of_known) {}

  void start();
  void stop() { thread_.stop(); }

  /// `work` makes the answer; without enough memory for it the answer is 503. It is not started if
  /// the request was answered by its deadline; once started its answer is sent, however late.
  void run(const ExchangePtr& exchange, const Asker& asker, std::function<Response()> work);

  std::chrono::nanoseconds cpu_time() const { return thread_.cpu_time(); }

 private:
  struct Waiting {
    std::string key;
    ExchangePtr exchange;
    std::function<Response()> work;
  };

  std::optional<Waiting> next();
  void work_all();

  const char* const thread_name_;
  const char* const busy_;
  const std::size_t most_of_known_;
  hal::BoundedQueue<Waiting, kMostWaiting> known_, unknown_;
  bool was_known_ = false;  ///< kind of the client served last; used by the thread only
  hal::Thread thread_;
};

}  // namespace orbwatch::app::web
