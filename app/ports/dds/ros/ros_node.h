// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dds/dds.h>

#include <cstdint>
#include <span>
#include <string_view>

#include "app/ports/dds/participant/entity.h"
#include "proc/image/result.h"

namespace orbwatch::app::dds {

/// Format of ros_discovery_info, which changed with rmw_dds_common 2.0.
enum class RosGeneration : std::uint8_t {
  Humble,  ///< Humble and before
  Iron,    ///< Iron and later
};

/// Name of our node in the ROS 2 graph.
inline constexpr std::string_view kNodeName = "orbwatch";
inline constexpr std::string_view kNodeNamespace = "/";

/// USER_DATA of a participant with nodes: without the security enclave ROS 2 does not show it in
/// its graph until its node is announced.
inline constexpr std::string_view kParticipantUserData = "enclave=/;";

/// Announces writers and readers of a participant as those of the node kNodeName, so that
/// `ros2 node list` and `ros2 node info` show it. Its participant needs kParticipantUserData.
/// Thread-bound.
class DiscoveryInfo {
 public:
  /// Topic name; not a ROS topic, so without "rt/".
  static constexpr const char* kTopic = "ros_discovery_info";

  /// Creates topic and writer; announces nothing yet. Error: a failure of DDS.
  Result<> open(const Entity& participant, RosGeneration generation);
  void close();

  /// Announces all endpoints of the node, replacing those announced before, also to late joiners; a
  /// node without endpoints is valid. To be called whenever an endpoint is created or deleted.
  /// Errors: not open, an invalid handle, a failure of DDS.
  Result<> announce(std::span<const dds_entity_t> writers, std::span<const dds_entity_t> readers);

 private:
  RosGeneration generation_ = RosGeneration::Iron;
  dds_entity_t participant_ = 0;
  Entity topic_;
  Entity writer_;
};

}  // namespace orbwatch::app::dds
