#pragma once

#include <cstdint>
#include <string_view>

namespace orbwatch::app {

/// How a participant tells ROS 2 of its nodes changed once, with rmw_dds_common 2.0.
enum class RosGeneration : std::uint8_t {
  Humble,  ///< and before
  Iron,    ///< and since
};

/// The node that ROS 2's graph shows.
inline constexpr std::string_view kNodeName = "orbwatch";
inline constexpr std::string_view kNodeNamespace = "/";

/// USER_DATA of a participant with nodes: without it ROS 2 knows no security enclave of ours, and
/// keeps the participant out of its graph until it hears of a node.
inline constexpr std::string_view kParticipantUserData = "enclave=/;";

}  // namespace orbwatch::app
