#include "app/ports/dds/pictures/picture_topic.h"

#include <utility>

#include "app/ports/dds/topics/topic_names.h"

namespace orbwatch::app {

PictureTopic::PictureTopic(std::string name, std::unique_ptr<PictureWriter> writer, double rate)
    : writer_(std::move(writer)),
      topic_(writer_->type(), std::move(name)),
      period_(hal::period_of(rate)) {}

Result<> PictureTopic::open(const Entity& participant) {
  if (open_) return {};
  if (const auto opened = topic_.open(participant, frame_qos()); !opened) return opened;
  mailbox_.open();
  open_ = true;
  thread_.start(writer_->thread_name(), [this] { run(); });
  return {};
}

void PictureTopic::close() {
  open_ = false;
  mailbox_.close();
  thread_.stop();
  mailbox_.discard();
  busy_ = false;
  topic_.close();
}

void PictureTopic::accept(const StampedPicture& picture) {
  const auto now = since_epoch(picture.stamp);
  if (!open_ || !topic_.has_reader()) {
    topic_.count_unread();
  } else if (!is_due(now)) {
    ++limited_;
  } else if (picture.is_scarce && busy_) {
    ++passed_over_;
  } else {
    due_ = (was_clock_set(now) ? now : due_) + period_;
    busy_ = true;
    mailbox_.put(picture);
  }
}

/// Tolerates jitter of a quarter period; a late picture does not delay the next.
bool PictureTopic::is_due(std::chrono::nanoseconds now) const {
  return was_clock_set(now) || now >= due_ - period_ / 4;
}

bool PictureTopic::was_clock_set(std::chrono::nanoseconds now) const {
  return now <= due_ - 2 * period_ || now >= due_ + period_;
}

void PictureTopic::run() {
  while (auto picture = mailbox_.take()) {
    writer_->write(std::move(*picture), topic_);
    busy_ = false;
  }
}

TopicStatistics PictureTopic::statistics() const {
  TopicStatistics statistics = topic_.statistics();
  statistics.replaced = mailbox_.drops() + passed_over_;
  statistics.limited = limited_;
  return statistics;
}

PictureTopics::PictureTopics(const std::string& raw, PixelFormat encoding, const JpegSettings& jpeg)
    : raw_(raw, std::make_unique<RawPictureWriter>(encoding)),
      compressed_(compressed_topic(raw), std::make_unique<JpegPictureWriter>(jpeg), jpeg.rate) {}

Result<> PictureTopics::open(const Entity& participant) {
  return raw_.open(participant).and_then([&] { return compressed_.open(participant); });
}

void PictureTopics::close() {
  raw_.close();
  compressed_.close();
}

void PictureTopics::accept(const StampedPicture& picture) {
  raw_.accept(picture);
  compressed_.accept(picture);
}

void PictureTopics::report(std::vector<TopicStatistics>& topics) const {
  topics.push_back(raw_.statistics());
  topics.push_back(compressed_.statistics());
}

}  // namespace orbwatch::app
