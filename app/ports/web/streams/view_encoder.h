#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

#include "app/model/view.h"
#include "app/pictures/jpeg_encoder.h"
#include "app/pictures/jpeg_quality.h"
#include "app/ports/web/streams/feed.h"
#include "hal/thread/mailbox.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app::web {

/// Compresses the newest picture of a view for its feed on shared threads, only while it is read.
/// Thread rule: wants and accept by the pipeline's thread; the rest by the owner.
class ViewEncoder {
 public:
  /// A view and the number under which its picture is sent next.
  using OnPicture = std::function<void(const ViewPtr&, std::uint64_t number)>;

  /// `on_picture` runs on the shared threads, before any reader has the picture.
  ViewEncoder(const JpegSettings& jpeg, std::shared_ptr<hal::SharedThreads> threads,
              OnPicture on_picture);

  /// Whether the picture of this moment is read, or wanted all the same.
  bool wants(hal::TimePoint stamp, bool is_wanted) const;
  /// Queues the picture and returns at once; the newest wins.
  void accept(const ViewPtr& view);
  /// Waits for the present picture and keeps none.
  void stop();

  const std::shared_ptr<Feed>& feed() const { return feed_; }
  std::chrono::nanoseconds cpu_time() const { return work_.cpu_time(); }
  /// Pictures that were replaced before they were compressed.
  std::uint64_t replaced() const { return mailbox_.drops(); }

 private:
  void encode();

  const hal::Clock::duration period_;  ///< between two pictures; 0: none
  hal::TimePoint due_;                 ///< of the next one; the accepting thread's
  hal::Mailbox<ViewPtr> mailbox_;
  JpegQuality quality_;
  JpegEncoder encoder_;
  const OnPicture on_picture_;
  const std::shared_ptr<Feed> feed_ = std::make_shared<Feed>();
  hal::SharedThreads::Work work_;
};

}  // namespace orbwatch::app::web
