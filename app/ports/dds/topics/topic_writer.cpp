// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/topics/topic_writer.h"

#include "app/ports/dds/ros/type_hash.h"

namespace orbwatch::app::dds {

Result<> TopicWriter::open(const Entity& participant, const Qos& qos) {
  if (writer_) return {};
  show_order_of_calls();
  const Listener listener(dds_create_listener(this));
  dds_lset_publication_matched(listener.get(), count_readers);
  auto writer = announce_type_hash(qos, type_)
                    .and_then([&] { return make_topic(participant, type_, name_); })
                    .and_then([&](Entity topic) {
                      topic_ = std::move(topic);
                      return make_writer(participant, topic_, qos, listener.get());
                    });
  if (!writer) {
    count_failure(writer.error().message);
    return fail(writer.error().message + " (" + name_ + ")");
  }
  writer_ = std::move(*writer);
  return {};
}

void TopicWriter::close() {
  writer_.reset();  // waits for calls of count_readers()
  show_order_of_calls();
  topic_.reset();
  readers_ = 0;
}

void TopicWriter::count_readers(dds_entity_t, dds_publication_matched_status_t status,
                                void* topic) {
  auto& self = *static_cast<TopicWriter*>(topic);
  show_order_of_calls();
  self.readers_ = status.current_count;
  show_order_of_calls();
}

void TopicWriter::count_failure(std::string message) {
  ++failed_;
  const std::lock_guard lock(mutex_);
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
  const std::lock_guard lock(mutex_);
  return {name_, readers_, written_, unread_, 0, 0, blocked_, failed_, last_error_};
}

}  // namespace orbwatch::app::dds
