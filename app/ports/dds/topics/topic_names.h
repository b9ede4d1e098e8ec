// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "proc/image/result.h"

namespace orbwatch::app::dds {

/// "rt/<prefix>/<name>".
inline std::string ros_topic(std::string_view prefix, std::string_view name) {
  return std::string("rt/").append(prefix).append("/").append(name);
}

/// DDS topic names, derived by the rule of ROS 2: "rt/" before the ROS name. The topics:
///   rt/<prefix>/<view>/image_raw              display picture
///   rt/<prefix>/<view>/radiometric/image_raw  measured plane, mono16 counts or mono8
///   rt/<prefix>/selected/image_raw            view selected by Status::selected_view
///   rt/<prefix>/<camera>/ball/image_raw       a camera's own picture
///   .../image_raw/compressed                  each picture except measured planes as JPEG
///   .../camera_info                           beside image_raw: the calibration of its picture,
///                                             for a perspective view or a camera with a known lens
///   rt/<prefix>/process_state                 process state
///   rt/<prefix>/event                         events
///   rt/<prefix>/command                       requests to orbwatch
///   rt/<prefix>/command_result                answers to the requests
///   rt/<prefix>/machine_state                 states of the machine, to orbwatch
///   rt/orbwatch_appliance                     appliances of the domain, regardless of prefix
///   rt/orbwatch_thumbnail                     thumbnails of their views
inline std::string image_topic(std::string_view prefix, std::string_view view) {
  return ros_topic(prefix, view) + "/image_raw";
}
inline std::string radiometric_topic(std::string_view prefix, std::string_view view) {
  return ros_topic(prefix, view) + "/radiometric/image_raw";
}
inline std::string ball_topic(std::string_view prefix, std::string_view camera) {
  return ros_topic(prefix, camera) + "/ball/image_raw";
}
/// Topic of the calibration beside an image topic, at the place that ROS 2 expects.
inline std::string camera_info_topic(std::string_view raw) {
  return std::string(raw.substr(0, raw.rfind('/'))) + "/camera_info";
}
/// The JPEG topic beside an image topic.
inline std::string compressed_topic(std::string_view raw) {
  return std::string(raw) + "/compressed";
}
inline std::string process_state_topic(std::string_view prefix) {
  return ros_topic(prefix, "process_state");
}
inline std::string event_topic(std::string_view prefix) { return ros_topic(prefix, "event"); }
inline std::string command_topic(std::string_view prefix) { return ros_topic(prefix, "command"); }
inline std::string command_result_topic(std::string_view prefix) {
  return ros_topic(prefix, "command_result");
}

inline std::string machine_state_topic(std::string_view prefix) {
  return ros_topic(prefix, "machine_state");
}

inline constexpr std::string_view kApplianceTopic = "rt/orbwatch_appliance";
inline constexpr std::string_view kThumbnailTopic = "rt/orbwatch_thumbnail";

/// Replaces a view's name in the topics of the selected view.
inline constexpr std::string_view kSelectedView = "selected";

/// Checks one part of a topic against the rules of ROS 2: letters, digits and underscores, no digit
/// first. `what` names it in the error.
Result<> check_topic_part(std::string_view part, std::string_view what);
/// Checks a path of parts separated by '/'.
Result<> check_topic_path(std::string_view path, std::string_view what);

}  // namespace orbwatch::app::dds
