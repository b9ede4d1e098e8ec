// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <ctime>
#include <functional>
#include <mutex>
#include <stop_token>
#include <string_view>
#include <thread>
#include <utility>

#include "hal/clock.h"
#include "hal/thread/priority_mutex.h"
#include "hal/thread/scheduling.h"

namespace orbwatch::hal {

/// Named thread that waits for work, works and stops. Its owner keeps the work under a lock of its
/// own and wakes the thread for it:
///
///     thread_.start("snapshot", [this] {
///       while (thread_.wait()) write_pictures();
///     });
///
/// A body that also waits for other events passes stop_token() to a condition_variable_any, or to a
/// stop_callback that signals an EventFd.
/// Thread rule: wake and cpu_time on any thread, also before start; wait and wait_until on the
/// thread itself; stop, stop_requested and stop_token on the owner's and the thread itself; the
/// rest on the owner's.
class Thread {
 public:
  /// Limit of the kernel; the rest of a name is cut.
  static constexpr std::size_t kMaxName = 15;

  Thread() = default;
  Thread(const Thread&) = delete;
  Thread& operator=(const Thread&) = delete;
  /// Stops the thread. If members that the body uses are destroyed earlier, the owner must stop it
  /// before.
  ~Thread() { stop(); }

  /// Runs `body`, which must not throw; a previous run is stopped first. `ps -L` and debuggers show
  /// `name`.
  void start(std::string_view name, ThreadRole role, std::function<void()> body);
  void start(std::string_view name, std::function<void()> body) {
    start(name, ThreadRole::Service, std::move(body));
  }

  /// Requests the stop and waits for the end of the body; on the thread itself it only requests.
  /// Repeating it does nothing.
  void stop();

  /// True from start() until stop() has waited for the end.
  bool is_running() const { return thread_.joinable(); }

  /// State of the newest start; the token belongs to it, too.
  bool stop_requested() const { return stop_.stop_requested(); }
  std::stop_token stop_token() const { return stop_.get_token(); }

  /// Processor time of all runs. Thread-safe.
  std::chrono::nanoseconds cpu_time() const;

  /// Ends a wait. Without a waiting thread, the next wait ends at once; several wakes count as one.
  /// Does not wait for work.
  void wake();

  /// Waits for a wake(). False: the stop was requested, perhaps with work left.
  bool wait();

  /// Waits for a wake() or until `moment`. False: the stop was requested.
  bool wait_until(TimePoint moment);

 private:
  static constexpr clockid_t kNoClock = CLOCK_REALTIME;  ///< never the clock of a thread

  PriorityMutex mutex_;
  std::condition_variable_any changed_;
  bool woken_ = false;
  std::stop_source stop_{std::nostopstate};
  // A std::jthread would not do: its stop_source cannot be used on the new thread before the
  // constructor's return.
  std::thread thread_;
  // Set by the thread itself.
  std::atomic<std::thread::id> runner_;
  std::atomic<clockid_t> clock_{kNoClock};  ///< clock of the thread's processor time
  std::atomic<std::int64_t> spent_{0};      ///< ns, sum of the runs that have ended
};

}  // namespace orbwatch::hal
