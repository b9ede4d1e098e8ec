// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>

#include "app/ports/dds/status/status_topics.h"
#include "hal/thread/bounded_queue.h"
#include "hal/thread/mailbox.h"

namespace orbwatch::app::dds {

/// Statuses on their way to the thread that publishes them. The newest one replaces others that
/// wait, except the first status of each result: the frame set in which `result` changes is the one
/// that was measured. If more than kMaxResults wait, the oldest is dropped. Allocates nothing.
/// Thread rule: put by the pipeline's thread, take and discard by one other; drops by any.
class StatusQueue {
 public:
  static constexpr std::size_t kMaxResults = 8;
  static_assert(kMaxResults < kStateDepth);  // the writer keeps the results of one take()

  void put(const StampedStatus& stamped) {
    const bool is_result = stamped.status.result != 0 && stamped.status.result != newest_result_;
    newest_result_ = stamped.status.result;
    const Numbered numbered{stamped, ++accepted_};
    if (!is_result) {
      newest_.put(numbered);
    } else if (!results_.put(numbered)) {
      // The other thread may have emptied the queue since.
      if (results_.try_take()) ++dropped_;
      results_.put(numbered);
    }
  }

  /// Calls `publish` with the results that wait, then with the newest status unless it is older.
  /// Ends although statuses arrive meanwhile.
  template <class Publish>
  void take(const Publish& publish) {
    // The newest first: every result before it is in the queue by then.
    const auto newest = newest_.try_take();
    for (std::size_t n = 0; n < kMaxResults; ++n) {
      const auto result = results_.try_take();
      if (!result) break;
      taken_ = result->number;
      publish(result->stamped);
    }
    if (!newest) return;
    if (newest->number < taken_) {
      ++dropped_;
    } else {
      publish(newest->stamped);
    }
  }

  /// Drops all waiting statuses.
  void discard() {
    newest_.discard();
    while (results_.try_take()) ++dropped_;
  }

  /// Number of statuses that were not taken.
  std::uint64_t drops() const { return newest_.drops() + dropped_; }

 private:
  struct Numbered {
    StampedStatus stamped;
    std::uint64_t number = 0;  ///< position among the accepted statuses
  };

  hal::Mailbox<Numbered> newest_;
  hal::BoundedQueue<Numbered, kMaxResults> results_;
  std::atomic<std::uint64_t> dropped_{0};  ///< besides those that `newest_` counts

  // Used by the pipeline's thread only.
  std::uint64_t accepted_ = 0;
  std::uint64_t newest_result_ = 0;

  std::uint64_t taken_ = 0;  ///< number of the newest result taken; used by its taker only
};

}  // namespace orbwatch::app::dds
