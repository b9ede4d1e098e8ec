#include "app/cli/keys/topic_access.h"

#include "app/ports/dds/topics/topic_names.h"

namespace orbwatch::app {
namespace {

/// The topic of ROS 2's graph: every participant writes and reads it.
constexpr const char* kDiscovery = "ros_discovery_info";

/// All but the requests: their readers share the key that protects them, and could forge some.
std::vector<std::string> published(std::string_view prefix) {
  std::vector<std::string> topics = bulk_topics(prefix);
  topics.insert(topics.end(), {process_state_topic(prefix), event_topic(prefix),
                               command_result_topic(prefix), "rt/diagnostics", kDiscovery});
  return topics;
}

}  // namespace

// Those of views and cameras: all below a name.
std::vector<std::string> bulk_topics(std::string_view prefix) {
  const std::string image = image_topic(prefix, "*");
  return {image.substr(0, image.rfind('/') + 1) + "*"};
}

TopicAccess appliance_access(std::string_view prefix) {
  return {published(prefix), {command_topic(prefix), kDiscovery}};
}

TopicAccess reader_access(std::string_view prefix) { return {{kDiscovery}, published(prefix)}; }

TopicAccess controller_access(std::string_view prefix) {
  return {{command_topic(prefix), kDiscovery}, published(prefix)};
}

}  // namespace orbwatch::app
