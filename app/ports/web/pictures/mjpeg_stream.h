#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "app/ports/web/pictures/picture_feed.h"

namespace orbwatch::app::web {

/// Of all streams since start.
struct StreamCounts {
  std::atomic<std::uint64_t> sent{0};     ///< pictures, begun
  std::atomic<std::uint64_t> skipped{0};  ///< for readers that were slower than the pictures
};

/// A feed as multipart/x-mixed-replace: what VLC, browsers and recorders play as MJPEG.
class MjpegStream final : public Stream {
 public:
  static constexpr std::string_view kType = "multipart/x-mixed-replace; boundary=orbwatch";

  /// `counts` outlives it.
  MjpegStream(std::shared_ptr<PictureFeed> feed, StreamCounts& counts)
      : feed_(std::move(feed)), counts_(counts) {}

  void on_data(std::function<void()> wake) override { reader_.emplace(feed_, std::move(wake)); }
  std::size_t read(std::span<char> out) override;

 private:
  bool begin_next();

  const std::shared_ptr<PictureFeed> feed_;
  StreamCounts& counts_;
  std::optional<PictureFeed::Reader> reader_;
  std::string head_;                       ///< of the newest picture
  Bytes picture_;                          ///< the newest one; null: there was none
  std::array<std::string_view, 3> parts_;  ///< what is left to send of head, picture and boundary
};

}  // namespace orbwatch::app::web
