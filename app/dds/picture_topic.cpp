#include "app/dds/picture_topic.h"

namespace orbwatch::app {
namespace {

std::chrono::nanoseconds period_of(double rate) {
  if (rate <= 0) return {};
  return std::chrono::duration_cast<std::chrono::nanoseconds>(
      std::chrono::duration<double>(1 / rate));
}

}  // namespace

PictureTopic::PictureTopic(std::string name, std::unique_ptr<PictureWriter> writer, double rate)
    : writer_(std::move(writer)),
      topic_(writer_->type(), std::move(name)),
      period_(period_of(rate)) {}

Result<> PictureTopic::open(const Entity& participant) {
  if (open_) return {};
  if (const auto opened = topic_.open(participant, frame_qos()); !opened) return opened;
  mailbox_.open();
  open_ = true;
  thread_ = std::thread([this] { run(); });
  return {};
}

void PictureTopic::close() {
  open_ = false;
  mailbox_.close();
  if (thread_.joinable()) thread_.join();
  if (mailbox_.try_take()) ++discarded_;
  topic_.close();
}

void PictureTopic::accept(const StampedPicture& picture) {
  if (!open_) return;
  if (!topic_.has_reader()) {
    topic_.count_unread();
  } else if (!is_due(picture.stamp)) {
    ++limited_;
  } else {
    mailbox_.put(picture);
  }
}

/// Pictures that jitter around the rate are not thinned out: a late one does not delay the next.
bool PictureTopic::is_due(const TimeMessage& stamp) {
  const auto now = since_epoch(stamp);
  if (now < due_ - period_ / 4 && now > due_ - 2 * period_) return false;
  due_ = now < due_ + period_ ? due_ + period_ : now + period_;
  return true;
}

void PictureTopic::run() {
  while (const auto picture = mailbox_.take()) writer_->write(*picture, topic_);
}

TopicStatistics PictureTopic::statistics() const {
  TopicStatistics statistics = topic_.statistics();
  statistics.replaced = mailbox_.drops() + discarded_;
  statistics.limited = limited_;
  return statistics;
}

}  // namespace orbwatch::app
