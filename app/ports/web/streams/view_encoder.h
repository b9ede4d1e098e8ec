// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

#include "app/model/sink/view.h"
#include "app/pictures/jpeg_encoder.h"
#include "app/pictures/jpeg_quality.h"
#include "app/ports/web/streams/feed.h"
#include "hal/thread/mailbox.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app::web {

/// Compresses the newest picture of a view for its feed on shared threads, only while the feed has
/// readers.
/// Thread rule: wants and accept on the pipeline's thread; everything else by the owner.
class ViewEncoder {
 public:
  /// Called with a view and the number under which its picture is sent next.
  using OnPicture = std::function<void(const ViewPtr&, std::uint64_t number)>;

  /// `on_picture` runs on the shared threads, before any reader has the picture.
  ViewEncoder(const JpegSettings& jpeg, std::shared_ptr<hal::SharedThreads> threads,
              OnPicture on_picture);

  /// Returns whether the picture of this moment has readers or is wanted otherwise.
  bool wants(hal::TimePoint stamp, bool is_wanted) const;
  /// Queues the picture and returns at once; the newest wins.
  void accept(const ViewPtr& view);
  /// Waits for the picture in progress and drops the waiting one.
  void stop();

  const std::shared_ptr<Feed>& feed() const { return feed_; }
  std::chrono::nanoseconds cpu_time() const { return work_.cpu_time(); }
  /// Number of pictures replaced before they were compressed.
  std::uint64_t replaced() const { return mailbox_.drops(); }

 private:
  void encode();

  const hal::Clock::duration period_;  ///< shortest interval of pictures; 0: no limit
  hal::TimePoint due_;  ///< time of the next picture; used by the accepting thread only
  hal::Mailbox<ViewPtr> mailbox_;
  JpegQuality quality_;
  JpegEncoder encoder_;
  const OnPicture on_picture_;
  const std::shared_ptr<Feed> feed_ = std::make_shared<Feed>();
  hal::SharedThreads::Work work_;
};

}  // namespace orbwatch::app::web
