// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

#include "app/ports/dds/dds_sink.h"
#include "app/ports/dds/pictures/image_message.h"
#include "tests/app/ports/dds/dds_network.h"
#include "tests/app/ports/dds/topic_reader.h"

/// Test data for the sink, and readers of its topics and counts.
namespace orbwatch::app::dds {

inline constexpr int kWidth = 160;
inline constexpr int kHeight = 90;
inline constexpr std::size_t kFront = 0;
inline constexpr std::size_t kWide = 1;

class ImageReader : public tests::TopicReader<ImageMessage> {
 public:
  explicit ImageReader(const std::string& topic)
      : TopicReader(sensor_msgs_msg_dds__Image__desc, topic, frame_qos()) {}
};

class CompressedReader : public tests::TopicReader<CompressedImageMessage> {
 public:
  explicit CompressedReader(const std::string& topic)
      : TopicReader(sensor_msgs_msg_dds__CompressedImage__desc, topic, frame_qos()) {}
};

inline DdsSettings settings(std::string prefix = "orbwatch") {
  return {.domain = tests::DdsNetwork::kSinkDomain, .prefix = std::move(prefix)};
}

inline TopicStatistics of_topic(const DdsSink& sink, const std::string& topic) {
  const auto statistics = sink.statistics();
  const auto found = std::ranges::find(statistics.topics, topic, &TopicStatistics::topic);
  if (found != statistics.topics.end()) return *found;
  ADD_FAILURE() << "no statistics of " << topic;
  return {};
}

inline std::uint64_t sum(const TopicStatistics& topic) {
  return topic.written + topic.unread + topic.replaced + topic.limited + topic.blocked +
         topic.failed;
}

}  // namespace orbwatch::app::dds
