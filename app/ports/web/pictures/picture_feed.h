#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "app/ports/web/http/exchange.h"
#include "hal/clock.h"

namespace orbwatch::app::web {

/// A picture as it is sent.
struct Jpeg {
  Bytes bytes;
  std::uint64_t number = 0;  ///< counts the pictures of its feed from 1
  hal::TimePoint stamp;      ///< of its exposure
};

/// The newest picture of one source for any number of readers, each at its own pace: one that is
/// slow gets the newest when it asks again. Thread-safe; holds no lock while others are called.
class PictureFeed {
 public:
  /// Reads on; while one exists, pictures are wanted.
  class Reader {
   public:
    /// `wake` is called after each new picture, on the publisher's thread.
    Reader(std::shared_ptr<PictureFeed> feed, std::function<void()> wake);
    ~Reader();
    Reader(const Reader&) = delete;
    Reader& operator=(const Reader&) = delete;

    /// The newest picture, unless it was returned before or is older than the reader.
    std::optional<Jpeg> next();
    /// Pictures that were never returned because newer ones came.
    std::uint64_t skipped() const { return skipped_; }

   private:
    friend PictureFeed;

    const std::shared_ptr<PictureFeed> feed_;
    const std::shared_ptr<const std::function<void()>> wake_;
    std::uint64_t newest_ = 0;  ///< number of the last one returned
    std::uint64_t skipped_ = 0;
  };

  /// Whether somebody waits for a picture. For the pipeline: no lock.
  bool is_wanted() const { return wanted_ > 0; }

  /// Answers `exchange` with the next picture as image/jpeg, if it is not answered before.
  void answer_next(ExchangePtr exchange);

  void publish(Bytes bytes, hal::TimePoint stamp);

 private:
  using Wake = std::shared_ptr<const std::function<void()>>;

  void count_wanted();

  mutable std::mutex mutex_;
  Jpeg newest_;
  std::vector<Wake> readers_;
  std::vector<ExchangePtr> waiting_;
  std::atomic<std::size_t> wanted_{0};
};

}  // namespace orbwatch::app::web
