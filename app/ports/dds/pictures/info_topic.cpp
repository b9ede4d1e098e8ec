// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/pictures/info_topic.h"

#include "app/ports/dds/participant/participant.h"
#include "app/ports/dds/pictures/camera_info.h"
#include "app/ports/dds/topics/topic_names.h"

namespace orbwatch::app::dds {

InfoTopic::InfoTopic(const std::string& raw)
    : topic_(sensor_msgs_msg_dds__CameraInfo__desc, camera_info_topic(raw)) {}

Result<> InfoTopic::open(const Entity& participant) {
  return topic_.open(participant, frame_qos());
}

void InfoTopic::close() {
  topic_.close();
  newest_.discard();
}

bool InfoTopic::accept(const StampedCalibration& picture) {
  const bool is_read = topic_.has_reader();
  if (is_read) {
    newest_.put(picture);
  } else {
    topic_.count_unread();
  }
  return is_read;
}

void InfoTopic::publish() {
  const auto newest = newest_.try_take();
  if (!newest) return;
  const auto* const view = std::get_if<optics::ViewSpec>(&newest->calibration);
  const auto lens =
      view ? lens_of(*view)
           : Result<optics::Intrinsics>(*std::get_if<optics::Intrinsics>(&newest->calibration));
  if (!lens) {
    topic_.count_failure(*newest->frame_id + ": " + lens.error().message);
    return;
  }
  const CameraInfoMessage message = camera_info(*lens, *newest->frame_id, newest->stamp);
  topic_.write(&message);
}

TopicStatistics InfoTopic::statistics() const {
  TopicStatistics statistics = topic_.statistics();
  statistics.replaced = newest_.drops();
  return statistics;
}

}  // namespace orbwatch::app::dds
