#pragma once

#include <string>
#include <vector>

#include "app/dds/ros/message_type.h"
#include "proc/image/result.h"

namespace orbwatch::app {

/// One file of a package.
struct PackageFile {
  std::string path;  ///< in the package's folder
  std::string text;
};

/// A type as ROS 2 writes it in a .msg file. Reentrant.
std::string msg_text(const MessageType& type);

/// The ROS 2 package orbwatch_msgs: package.xml, CMakeLists.txt, a .msg file for every type of ours
/// and a table of them. Error: as message_types(). Reentrant.
Result<std::vector<PackageFile>> message_package();

}  // namespace orbwatch::app
