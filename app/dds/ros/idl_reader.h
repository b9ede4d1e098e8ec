#pragma once

#include <string_view>

#include "app/dds/ros/message_type.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// Reads the part of OMG IDL 4.2 that messages of ROS 2 consist of: structs in modules, with basic
/// types, strings, structs that stand before, arrays of one dimension and unbounded sequences. The
/// text is preprocessed; comments before a struct, and before or behind a member, belong to it. A
/// struct that comes again, as it does with every file that includes it, is read once. Error: the
/// first word that is none of this, with its line. Reentrant.
Result<MessageTypes> read_idl(std::string_view text);

/// The ROS 2 name of an IDL type: "sensor_msgs/msg/Image" of "sensor_msgs::msg::dds_::Image_".
/// Reentrant.
std::string ros_type_name(std::string_view idl_name);

}  // namespace orbwatch::app
