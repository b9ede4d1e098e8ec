#include "app/dds/topic_writer.h"

namespace orbwatch::app {

Result<> TopicWriter::open(const Entity& participant, const Qos& qos) {
  if (writer_) return {};
  auto writer = make_topic(participant, type_, name_).and_then([&](Entity topic) {
    topic_ = std::move(topic);
    return make_writer(participant, topic_, qos);
  });
  if (!writer) {
    count_failure(writer.error().message);
    return fail(writer.error().message + " (" + name_ + ")");
  }
  writer_ = std::move(*writer);
  return {};
}

void TopicWriter::close() {
  writer_.reset();
  topic_.reset();
}

void TopicWriter::count_failure(std::string message) {
  ++failed_;
  const std::lock_guard lock(error_mutex_);
  last_error_ = std::move(message);
}

void TopicWriter::write(const void* sample) {
  const dds_return_t code = dds_write(writer_.get(), sample);
  if (code == DDS_RETCODE_OK) {
    ++written_;
  } else if (code == DDS_RETCODE_TIMEOUT) {
    ++blocked_;
  } else {
    count_failure(dds_error("write", code).message);
  }
}

TopicStatistics TopicWriter::statistics() const {
  const std::lock_guard lock(error_mutex_);
  return {name_, written_, unread_, blocked_, failed_, last_error_};
}

}  // namespace orbwatch::app
