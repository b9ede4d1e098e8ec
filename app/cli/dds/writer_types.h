#pragma once

#include <map>
#include <string>
#include <string_view>

#include "app/ports/dds/participant/entity.h"
#include "app/ports/dds/topics/topic_reader.h"
#include "hal/clock.h"

namespace orbwatch::app {

/// A type as ROS 2 names it: "sensor_msgs/msg/Image" of "sensor_msgs::msg::dds_::Image_"; others
/// as they are. One line, whatever was sent. Reentrant.
std::string type_text(std::string_view type);

/// The types of the writers in a domain. DDS never matches a reader with a writer of another type,
/// and says nothing. Thread-bound.
class WriterTypes {
 public:
  /// Writers of the right type may be discovered a while after others.
  static constexpr std::chrono::seconds kDiscovery{2};

  /// Error: DDS refuses.
  Result<> open(const Entity& participant);

  /// Takes what was discovered since. Error: DDS refuses.
  Result<> update(hal::TimePoint now);

  /// The type with which a topic is written, when `reader` has none of its own type to read from
  /// for kDiscovery; else empty.
  std::string unreadable(const TopicReader& reader, hal::TimePoint now) const;

 private:
  using Types = std::map<std::string, hal::TimePoint>;  ///< with the time of discovery

  Entity reader_;
  std::map<std::string, Types> topics_;
};

}  // namespace orbwatch::app
