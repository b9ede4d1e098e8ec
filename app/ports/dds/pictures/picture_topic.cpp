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
  topic_.close();
}

void PictureTopic::accept(const StampedPicture& picture) {
  if (!open_ || !topic_.has_reader()) {
    topic_.count_unread();
  } else if (!is_due(picture.stamp)) {
    ++limited_;
  } else {
    mailbox_.put(picture);
  }
}

/// Tolerates jitter of a quarter period; a late picture does not delay the next.
bool PictureTopic::is_due(const TimeMessage& stamp) {
  const auto now = since_epoch(stamp);
  const bool clock_was_set = now <= due_ - 2 * period_ || now >= due_ + period_;
  if (!clock_was_set && now < due_ - period_ / 4) return false;
  due_ = (clock_was_set ? now : due_) + period_;
  return true;
}

void PictureTopic::run() {
  while (auto picture = mailbox_.take()) writer_->write(std::move(*picture), topic_);
}

TopicStatistics PictureTopic::statistics() const {
  TopicStatistics statistics = topic_.statistics();
  statistics.replaced = mailbox_.drops();
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
