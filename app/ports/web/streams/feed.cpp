// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/streams/feed.h"

#include <string>
#include <utility>

#include "app/model/status/utc_text.h"

namespace orbwatch::app::web {

Feed::Reader::Reader(std::shared_ptr<Feed> feed, std::function<void()> wake)
    : feed_(std::move(feed)),
      wake_(std::make_shared<const std::function<void()>>(std::move(wake))) {
  const std::lock_guard lock(feed_->mutex_);
  returned_ = feed_->place_;
  feed_->readers_.push_back(wake_);
  feed_->count_wanted();
}

Feed::Reader::~Reader() {
  const std::lock_guard lock(feed_->mutex_);
  std::erase(feed_->readers_, wake_);
  feed_->count_wanted();
}

std::optional<Item> Feed::Reader::next() {
  const std::lock_guard lock(feed_->mutex_);
  if (feed_->place_ == returned_) return std::nullopt;
  skipped_ += feed_->place_ - returned_ - 1;
  returned_ = feed_->place_;
  return feed_->newest_;
}

void Feed::answer_next(ExchangePtr exchange) {
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [](const ExchangePtr& other) { return other->is_answered(); });
  waiting_.push_back(std::move(exchange));
  count_wanted();
}

void Feed::publish(Item item) {
  const Bytes bytes = item.bytes;
  const std::string stamp = utc_text(hal::to_utc(item.stamp)).value_or("");
  std::vector<Wake> readers;
  std::vector<ExchangePtr> waiting;
  {
    const std::lock_guard lock(mutex_);
    ++place_;
    if (item.number == 0) item.number = place_;
    newest_ = std::move(item);
    readers = readers_;
    waiting = std::exchange(waiting_, {});
    count_wanted();
  }
  for (const ExchangePtr& exchange : waiting) {
    Response picture = body_response(kJpeg, bytes);
    picture.headers = {{"X-Timestamp", stamp}};
    exchange->answer(std::move(picture));
  }
  for (const Wake& wake : readers) (*wake)();
}

void Feed::count_wanted() { wanted_ = readers_.size() + waiting_.size(); }

}  // namespace orbwatch::app::web
