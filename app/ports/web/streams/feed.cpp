// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/streams/feed.h"

#include <utility>

namespace orbwatch::app::web {

Feed::Reader::Reader(std::shared_ptr<Feed> feed, std::function<void()> wake)
    : feed_(std::move(feed)),
      wake_(std::make_shared<const std::function<void()>>(std::move(wake))) {
  const std::lock_guard lock(feed_->mutex_);
  newest_ = feed_->newest_.number;
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
  const Item& newest = feed_->newest_;
  if (newest.number == newest_) return std::nullopt;
  skipped_ += newest.number - newest_ - 1;
  newest_ = newest.number;
  return newest;
}

void Feed::answer_next(ExchangePtr exchange) {
  const std::lock_guard lock(mutex_);
  std::erase_if(waiting_, [](const ExchangePtr& other) { return other->is_answered(); });
  waiting_.push_back(std::move(exchange));
  count_wanted();
}

void Feed::publish(Bytes bytes, hal::TimePoint stamp, const std::optional<Aim>& aim) {
  std::vector<Wake> readers;
  std::vector<ExchangePtr> waiting;
  {
    const std::lock_guard lock(mutex_);
    newest_ = {std::move(bytes), newest_.number + 1, stamp, aim};
    readers = readers_;
    waiting = std::exchange(waiting_, {});
    count_wanted();
    bytes = newest_.bytes;
  }
  for (const ExchangePtr& exchange : waiting) exchange->answer(body_response(kJpeg, bytes));
  for (const Wake& wake : readers) (*wake)();
}

std::uint64_t Feed::next_number() const {
  const std::lock_guard lock(mutex_);
  return newest_.number + 1;
}

void Feed::count_wanted() { wanted_ = readers_.size() + waiting_.size(); }

}  // namespace orbwatch::app::web
