// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "app/ports/web/http/exchange.h"
#include "app/ports/web/views/aim.h"
#include "hal/clock.h"

namespace orbwatch::app::web {

/// Item of a feed: a picture as JPEG, or the status as JSON.
struct Item {
  Bytes bytes;
  std::uint64_t number = 0;  ///< counts the items of its feed from 1
  hal::TimePoint stamp;      ///< exposure start, or time of the report
  std::optional<Aim> aim;    ///< aim of a picture
};

/// The newest item of one source for any number of readers, each at its own pace: a slow reader
/// gets the newest item at its next read. Thread-safe; holds no lock during callbacks.
class Feed {
 public:
  /// Reader of a feed; while one exists, items are wanted.
  class Reader {
   public:
    /// `wake` is called after each new item, on the publisher's thread.
    Reader(std::shared_ptr<Feed> feed, std::function<void()> wake);
    ~Reader();
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    /// The newest item, unless it was returned before or is older than the reader.
    std::optional<Item> next();
    /// Number of items that were never returned because newer ones replaced them.
    std::uint64_t skipped() const { return skipped_; }

   private:
    friend Feed;

    const std::shared_ptr<Feed> feed_;
    const std::shared_ptr<const std::function<void()>> wake_;
    std::uint64_t newest_ = 0;  ///< number of the last item returned
    std::uint64_t skipped_ = 0;
  };

  /// Returns whether a reader or a request waits for an item. Takes no lock, for the pipeline.
  bool is_wanted() const { return wanted_ > 0; }

  /// Answers `exchange` with the next item, a picture, unless it is answered earlier.
  void answer_next(ExchangePtr exchange);

  void publish(Bytes bytes, hal::TimePoint stamp, const std::optional<Aim>& aim = std::nullopt);
  /// Number of the item that is published next. For the single publisher.
  std::uint64_t next_number() const;

 private:
  using Wake = std::shared_ptr<const std::function<void()>>;

  void count_wanted();

  mutable std::mutex mutex_;
  Item newest_;
  std::vector<Wake> readers_;
  std::vector<ExchangePtr> waiting_;
  std::atomic<std::size_t> wanted_{0};
};

}  // namespace orbwatch::app::web
