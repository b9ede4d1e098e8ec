// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>

#include "app/model/sink/view.h"
#include "app/pictures/jpeg_encoder.h"
#include "app/pictures/jpeg_quality.h"
#include "app/pictures/picture_scaler.h"
#include "app/ports/web/streams/picture_feeds.h"
#include "app/ports/web/streams/picture_sizes.h"
#include "hal/thread/mailbox.h"
#include "hal/thread/shared_threads.h"

namespace orbwatch::app::web {

/// Compresses the newest picture of a view on shared threads, once in each size whose feed has
/// readers, for all of them.
/// Thread rule: wants and accept on the pipeline's thread; everything else by the owner.
class ViewEncoder {
 public:
  /// Called with a view and the number under which its picture is sent next, in every size.
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

  const PictureFeeds& feeds() const { return feeds_; }
  std::chrono::nanoseconds cpu_time() const { return work_.cpu_time(); }
  /// Number of pictures replaced before they were compressed.
  std::uint64_t replaced() const { return mailbox_.drops(); }
  /// Number of pictures compressed, in all sizes together.
  std::uint64_t compressed_pictures() const { return compressed_; }

 private:
  void encode();
  Result<Bytes> compressed(const Picture& picture, std::size_t size);

  const hal::Clock::duration period_;  ///< shortest interval of pictures; 0: no limit
  hal::TimePoint due_;  ///< time of the next picture; used by the accepting thread only
  hal::Mailbox<ViewPtr> mailbox_;
  const PictureFeeds feeds_;
  std::array<JpegQuality, kQuarters.size()> qualities_;  ///< by size
  PictureScaler scaler_;
  JpegEncoder encoder_;
  std::uint64_t number_ = 0;  ///< number of the newest picture; used by encode() only
  std::atomic<std::uint64_t> compressed_{0};
  const OnPicture on_picture_;
  hal::SharedThreads::Work work_;
};

}  // namespace orbwatch::app::web
