#pragma once

#include <dds/dds.h>

#include <span>

#include "app/dds/entity.h"
#include "app/dds/ros/ros_node.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Tells ROS 2 that writers and readers of a participant belong to the node kNodeName, so that
/// `ros2 node list` and `ros2 node info` show it. Its participant needs kParticipantUserData.
/// Thread-bound.
class DiscoveryInfo {
 public:
  /// The topic, which is no ROS topic and has no "rt/".
  static constexpr const char* kTopic = "ros_discovery_info";

  /// Creates topic and writer; nothing is announced yet. Error: DDS refuses.
  Result<> open(const Entity& participant, RosGeneration generation);
  void close();

  /// Announces all endpoints of the node, in place of those announced before; without any the node
  /// is still there. What comes later to the network is told too. Call it whenever one is created
  /// or deleted. Errors: not open, a handle that is none, DDS refuses.
  Result<> announce(std::span<const dds_entity_t> writers, std::span<const dds_entity_t> readers);

 private:
  RosGeneration generation_ = RosGeneration::Iron;
  dds_entity_t participant_ = 0;
  Entity topic_;
  Entity writer_;
};

}  // namespace orbwatch::app
