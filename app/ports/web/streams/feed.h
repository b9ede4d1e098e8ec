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
  /// Number from 1 of the picture, the same in every size; 0: publish() sets its place in the feed.
  std::uint64_t number = 0;
  hal::TimePoint stamp;      ///< exposure start, or time of the report
  std::optional<Aim> aim{};  ///< aim of a picture
  int width = 0;             ///< width of the full picture, px; 0: not known
  int height = 0;
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
    std::uint64_t returned_ = 0;  ///< place of the last item returned
    std::uint64_t skipped_ = 0;
  };

  /// Returns whether a reader or a request waits for an item. Takes no lock, for the pipeline.
  bool is_wanted() const { return wanted_ > 0; }

  /// Answers `exchange` with the next item, a picture, unless it is answered earlier.
  void answer_next(ExchangePtr exchange);

  void publish(Item item);

 private:
  using Wake = std::shared_ptr<const std::function<void()>>;

  void count_wanted();

  std::mutex mutex_;
  Item newest_;
  std::uint64_t place_ = 0;  ///< place of the newest item, from 1; 0: none yet
  std::vector<Wake> readers_;
  std::vector<ExchangePtr> waiting_;
  std::atomic<std::size_t> wanted_{0};
};

}  // namespace orbwatch::app::web
