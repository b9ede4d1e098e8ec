// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/streams/view_encoder.h"

#include <algorithm>
#include <utility>

#include "app/log.h"

namespace orbwatch::app::web {
namespace {

/// Limit of the quality in the smaller sizes, whose clients ask for few bytes.
constexpr int kReducedQuality = 75;

std::array<JpegQuality, kQuarters.size()> qualities(const JpegSettings& jpeg) {
  JpegSettings reduced = jpeg;
  reduced.quality = std::min(reduced.quality, kReducedQuality);
  return {JpegQuality(jpeg), JpegQuality(reduced), JpegQuality(reduced), JpegQuality(reduced)};
}

}  // namespace

ViewEncoder::ViewEncoder(const JpegSettings& jpeg, std::shared_ptr<hal::SharedThreads> threads,
                         OnPicture on_picture)
    : period_(hal::period_of(jpeg.rate)),
      qualities_(qualities(jpeg)),
      on_picture_(std::move(on_picture)),
      work_(std::move(threads), [this] { encode(); }) {}

/// Returns whether a picture is due, with a tolerance of a quarter period for jitter.
bool ViewEncoder::wants(hal::TimePoint stamp, bool is_wanted) const {
  return (is_wanted || feeds_.are_wanted()) && stamp >= due_ - period_ / 4;
}

void ViewEncoder::accept(const ViewPtr& view) {
  // A late picture does not delay the next one, and a pause is not followed by a burst.
  due_ = (view->stamp - due_ > period_ ? view->stamp : due_) + period_;
  mailbox_.put(view);
  work_.request();
}

void ViewEncoder::stop() {
  work_.cancel();
  mailbox_.discard();
}

Result<Bytes> ViewEncoder::compressed(const Picture& picture, std::size_t size) {
  const Picture sized = size == kFullSize ? picture
                                          : scaler_.scaled(picture, side_in(size, picture.width),
                                                           side_in(size, picture.height));
  return encoder_.encode(sized, qualities_[size]).map([](std::span<std::uint8_t> bytes) {
    return Bytes(std::make_shared<const std::string>(bytes.begin(), bytes.end()));
  });
}

void ViewEncoder::encode() {
  const auto taken = mailbox_.try_take();
  if (!taken) return;
  const View& view = **taken;
  const std::uint64_t number = ++number_;
  on_picture_(*taken, number);
  for (std::size_t size = 0; size < kQuarters.size(); ++size) {
    Feed& feed = *feeds_.of(size);
    if (!feed.is_wanted()) continue;
    auto jpeg = compressed(view.picture, size);
    if (!jpeg) {
      log_line(LogLevel::Error, "web: " + jpeg.error().message);
      return;
    }
    ++compressed_;
    feed.publish({std::move(*jpeg), number, view.stamp, aim_of(view), view.picture.width,
                  view.picture.height});
  }
}

}  // namespace orbwatch::app::web
