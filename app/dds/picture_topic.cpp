#include "app/dds/picture_topic.h"

#include <utility>

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

/// Pictures that jitter around the rate are not thinned out: a late one does not delay the next.
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

}  // namespace orbwatch::app
