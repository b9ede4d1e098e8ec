// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "app/ports/web/streams/feed.h"
#include "app/ports/web/streams/parts.h"
#include "app/ports/web/streams/stream_counts.h"

namespace orbwatch::app::web {

/// A feed as multipart/x-mixed-replace, which VLC, browsers and recorders play as MJPEG.
class MjpegStream final : public Stream {
 public:
  static constexpr std::string_view kType = "multipart/x-mixed-replace; boundary=orbwatch";

  /// `counts` outlives the stream.
  MjpegStream(std::shared_ptr<Feed> feed, StreamCounts& counts)
      : feed_(std::move(feed)), counts_(counts) {}

  void on_data(std::function<void()> wake) override { reader_.emplace(feed_, std::move(wake)); }
  std::size_t read(std::span<char> out) override;

 private:
  bool begin_next();

  const std::shared_ptr<Feed> feed_;
  StreamCounts& counts_;
  std::optional<Feed::Reader> reader_;
  std::string head_;  ///< head of the newest picture
  Bytes picture_;     ///< newest picture; null: none yet
  Parts parts_;       ///< head, picture and boundary
};

}  // namespace orbwatch::app::web
