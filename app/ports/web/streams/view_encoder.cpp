// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/streams/view_encoder.h"

#include <utility>

#include "app/log.h"

namespace orbwatch::app::web {

ViewEncoder::ViewEncoder(const JpegSettings& jpeg, std::shared_ptr<hal::SharedThreads> threads,
                         OnPicture on_picture)
    : period_(hal::period_of(jpeg.rate)),
      quality_(jpeg),
      on_picture_(std::move(on_picture)),
      work_(std::move(threads), [this] { encode(); }) {}

/// Returns whether a picture is due, with a tolerance of a quarter period for jitter.
bool ViewEncoder::wants(hal::TimePoint stamp, bool is_wanted) const {
  return (is_wanted || feed_->is_wanted()) && stamp >= due_ - period_ / 4;
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

void ViewEncoder::encode() {
  auto view = mailbox_.try_take();
  if (!view) return;
  auto jpeg = encoder_.encode((*view)->picture, quality_.current());
  while (jpeg && quality_.adapt(jpeg->size())) {
    jpeg = encoder_.encode((*view)->picture, quality_.current());
  }
  const hal::TimePoint stamp = (*view)->stamp;
  const Aim aim = aim_of(**view);
  if (!jpeg) {
    log_line(LogLevel::Error, "web: " + jpeg.error().message);
    return;
  }
  on_picture_(*view, feed_->next_number());
  view.reset();
  feed_->publish(std::make_shared<const std::string>(jpeg->begin(), jpeg->end()), stamp, aim);
}

}  // namespace orbwatch::app::web
