#pragma once

#include <string>
#include <string_view>

#include "app/dds/entity.h"
#include "app/dds/ros/message_type.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// The hash by which ROS 2 (Iron and later) compares a type of `types`, named as in
/// "sensor_msgs/msg/Image": "RIHS01_" and the SHA-256 of the type's description in JSON (REP 2011;
/// rosidl_generator_type_description). Error: no such type. Reentrant.
Result<std::string> type_hash(const MessageTypes& types, std::string_view name);

/// Puts the hash of an endpoint's type where ROS 2 looks for it: "typehash=RIHS01_...;" in the
/// USER_DATA of the writer or reader that is made with `qos`. Every endpoint of a ROS topic
/// ("rt/...") gets one; Humble, which knows no hashes, ignores it. Error: a type that is not in
/// app/dds/idl. Reentrant.
Result<> announce_type_hash(const Qos& qos, const dds_topic_descriptor_t& type);

}  // namespace orbwatch::app
