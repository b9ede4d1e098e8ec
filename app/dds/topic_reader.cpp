#include "app/dds/topic_reader.h"

#include "app/dds/ros/type_hash.h"

namespace orbwatch::app {

Result<> TopicReader::open(const Entity& participant, const Qos& qos,
                           const dds_listener_t* listener) {
  auto reader = announce_type_hash(qos, *type_)
                    .and_then([&] { return make_topic(participant, *type_, name_); })
                    .and_then([&](Entity topic) {
                      topic_ = std::move(topic);
                      return make_reader(participant, topic_, qos, listener);
                    });
  if (!reader) return fail(reader.error().message + " (" + name_ + ")");
  reader_ = std::move(*reader);
  return {};
}

void TopicReader::close() {
  reader_.reset();
  topic_.reset();
}

}  // namespace orbwatch::app
