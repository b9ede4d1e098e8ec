#pragma once

#include <cstdint>
#include <string_view>

namespace orbwatch::app {

/// The form of ros_discovery_info changed once, with rmw_dds_common 2.0.
enum class RosGeneration : std::uint8_t {
  Humble,  ///< and before
  Iron,    ///< and since
};

/// Our node in ROS 2's graph.
inline constexpr std::string_view kNodeName = "orbwatch";
inline constexpr std::string_view kNodeNamespace = "/";

/// USER_DATA of a participant with nodes: without the security enclave ROS 2 keeps it out of its
/// graph until its node is announced.
inline constexpr std::string_view kParticipantUserData = "enclave=/;";

}  // namespace orbwatch::app
