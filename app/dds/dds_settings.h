#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "app/dds/ros/ros_node.h"
#include "app/dds/security/participant_security.h"
#include "app/pictures/jpeg_quality.h"
#include "proc/image/pixel_format.h"

namespace orbwatch::app {

/// Which topics a view has beside those of its picture.
struct PublishedView {
  PixelFormat encoding = PixelFormat::Rgb;  ///< or Bgr or Grey
  bool perspective = true;                  ///< camera_info describes it
  bool measured = true;                     ///< it has a plane that is measured
};

/// Where and how to publish.
struct DdsSettings {
  bool enabled = true;
  int domain = 0;                              ///< DDS domain, ROS_DOMAIN_ID of ROS 2; 0 to 230
  std::string prefix = "orbwatch";             ///< topics are rt/<prefix>/...
  bool commands = true;                        ///< take commands
  std::optional<SecuritySettings> security{};  ///< none: everybody in the domain may take part
  JpegSettings jpeg{};
  /// Cyclone DDS' settings of the network, its interfaces and peers; empty: what CYCLONEDDS_URI
  /// says.
  std::filesystem::path profile{};
  RosGeneration ros = RosGeneration::Iron;
  /// By name; what is not in them is published as a default one.
  std::map<std::string, PublishedView> views{};
  std::map<std::string, PixelFormat> cameras{};  ///< encoding: Rgb, Bgr or Grey
};

}  // namespace orbwatch::app
