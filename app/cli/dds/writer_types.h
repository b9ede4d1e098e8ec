// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "app/ports/dds/participant/entity.h"
#include "app/ports/dds/topics/topic_reader.h"
#include "hal/clock.h"

namespace orbwatch::app::cli {

/// ROS 2's name of a type: "sensor_msgs/msg/Image" for "sensor_msgs::msg::dds_::Image_"; other
/// names are unchanged. One line for any input. Reentrant.
std::string type_text(std::string_view type);

/// Types of the writers in a domain. DDS never matches a reader with a writer of another type, and
/// does not report it. Thread-bound.
class WriterTypes {
 public:
  /// Time during which writers of the right type may be discovered after others.
  static constexpr std::chrono::seconds kDiscovery{2};

  /// Error: DDS refuses.
  Result<> open(const dds::Entity& participant);

  /// Takes the writers discovered since the last call. Error: DDS refuses.
  Result<> update(hal::TimePoint now);

  /// The type with which a topic is written, if `reader` has found no writer of its own type for
  /// kDiscovery; else empty.
  std::string unreadable(const dds::TopicReader& reader, hal::TimePoint now) const;

 private:
  using Types = std::map<std::string, hal::TimePoint>;  ///< time of discovery of each type

  dds::Entity reader_;
  std::map<std::string, Types> topics_;
};

}  // namespace orbwatch::app::cli
