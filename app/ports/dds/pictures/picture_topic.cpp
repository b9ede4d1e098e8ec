// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/pictures/picture_topic.h"

#include <utility>

#include "app/ports/dds/topics/topic_names.h"

namespace orbwatch::app::dds {

PictureTopic::PictureTopic(std::string name, std::unique_ptr<PictureWriter> writer,
                           std::shared_ptr<hal::SharedThreads> threads, double rate)
    : writer_(std::move(writer)),
      topic_(writer_->type(), std::move(name)),
      period_(hal::period_of(rate)),
      work_(std::move(threads), [this] { write_newest(); }) {}

Result<> PictureTopic::open(const Entity& participant) {
  if (open_) return {};
  if (const auto opened = topic_.open(participant, frame_qos()); !opened) return opened;
  open_ = true;
  return {};
}

void PictureTopic::close() {
  open_ = false;
  work_.cancel();
  mailbox_.discard();
  busy_ = false;
  topic_.close();
}

void PictureTopic::accept(const StampedPicture& picture, bool serves) {
  const auto now = since_epoch(picture.stamp);
  const bool is_read = open_ && topic_.has_reader();
  if (is_read && !is_due(now)) {
    ++limited_;
  } else if (!is_read || !serves) {
    mailbox_.withdraw();  // only the rate limit makes a picture wait that is not the newest
    topic_.count_unread();
  } else if (picture.is_scarce && busy_) {
    ++passed_over_;
  } else {
    count_from(now);
    busy_ = true;
    mailbox_.put(picture);
    work_.request();
  }
}

TopicWriter& PictureTopic::take_part(const TimeMessage& stamp) {
  mailbox_.withdraw();
  count_from(since_epoch(stamp));
  return topic_;
}

void PictureTopic::count_from(std::chrono::nanoseconds now) {
  due_ = (was_clock_set(now) ? now : due_) + period_;
}

bool PictureTopic::wants(const TimeMessage& stamp) const {
  return open_ && topic_.has_reader() && is_due(since_epoch(stamp));
}

/// Tolerates jitter of a quarter period; a late picture does not delay the next.
bool PictureTopic::is_due(std::chrono::nanoseconds now) const {
  return was_clock_set(now) || now >= due_ - period_ / 4;
}

bool PictureTopic::was_clock_set(std::chrono::nanoseconds now) const {
  return now <= due_ - 2 * period_ || now >= due_ + period_;
}

void PictureTopic::write_newest() {
  auto picture = mailbox_.try_take();
  // The picture may have been accepted while the topic was closed.
  if (picture && open_) writer_->write(std::move(*picture), topic_);
  busy_ = false;
}

TopicStatistics PictureTopic::statistics() const {
  TopicStatistics statistics = topic_.statistics();
  statistics.replaced = mailbox_.drops() + passed_over_;
  statistics.limited = limited_;
  return statistics;
}

PictureTopics::PictureTopics(const std::string& raw, PixelFormat encoding, const JpegSettings& jpeg,
                             const std::shared_ptr<hal::SharedThreads>& threads)
    : encoding_(encoding),
      raw_(raw, std::make_unique<RawPictureWriter>(encoding), threads),
      compressed_(compressed_topic(raw), std::make_unique<JpegPictureWriter>(jpeg), threads,
                  jpeg.rate) {}

Result<> PictureTopics::open(const Entity& participant) {
  return raw_.open(participant).and_then([&] { return compressed_.open(participant); });
}

void PictureTopics::close() {
  raw_.close();
  compressed_.close();
}

PictureNeeds PictureTopics::ask(const TimeMessage& stamp) {
  raw_asked_ = raw_.wants(stamp);
  compressed_asked_ = compressed_.wants(stamp);
  PictureNeeds needs = raw_asked_ ? need_of(encoding_) : PictureNeeds{};
  needs.jpeg = compressed_asked_;
  return needs;
}

void PictureTopics::accept(const StampedPicture& picture, PictureTopics* same) {
  raw_.accept(picture, raw_asked_);
  if (same) same->raw_.accept(picture, same->raw_asked_);
  StampedPicture compressed = picture;
  if (same && compressed_asked_ && same->compressed_asked_) {
    compressed.also = &same->compressed_.take_part(picture.stamp);
  } else if (same) {
    same->compressed_.accept(picture, same->compressed_asked_);
  }
  compressed_.accept(compressed, compressed_asked_);
}

void PictureTopics::report(std::vector<TopicStatistics>& topics) const {
  topics.push_back(raw_.statistics());
  topics.push_back(compressed_.statistics());
}

}  // namespace orbwatch::app::dds
