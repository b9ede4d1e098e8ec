#include "app/dds/ros/message_package.h"

#include <algorithm>

#include "app/dds/ros/message_types.h"
#include "app/health/health.h"
#include "proc/signals/signals.h"

namespace orbwatch::app {
namespace {

constexpr std::string_view kMessages = "orbwatch_msgs/msg/";

constexpr std::string_view kPackageXml = R"(<?xml version="1.0"?>
<package format="3">
  <name>orbwatch_msgs</name>
  <version>@VERSION@</version>
  <description>Messages of orbwatch: what it measures, its alarms, its commands</description>
  <maintainer email="maintainers@orbwatch.invalid">orbwatch</maintainer>
  <license>Apache-2.0</license>

  <buildtool_depend>ament_cmake</buildtool_depend>
  <buildtool_depend>rosidl_default_generators</buildtool_depend>
  <depend>builtin_interfaces</depend>
  <exec_depend>rosidl_default_runtime</exec_depend>
  <member_of_group>rosidl_interface_packages</member_of_group>

  <export>
    <build_type>ament_cmake</build_type>
  </export>
</package>
)";

constexpr std::string_view kCMakeLists = R"(cmake_minimum_required(VERSION 3.8)
project(orbwatch_msgs)

find_package(ament_cmake REQUIRED)
find_package(builtin_interfaces REQUIRED)
find_package(rosidl_default_generators REQUIRED)

rosidl_generate_interfaces(${PROJECT_NAME}
@FILES@  DEPENDENCIES builtin_interfaces)

ament_export_dependencies(rosidl_default_runtime)
ament_package()
)";

constexpr std::string_view kReadme = R"(# orbwatch_msgs/msg

Written from the IDL in `app/dds/idl`: `orbwatch describe messages -o app/dds/orbwatch_msgs`.

| message | holds |
|---|---|
@MESSAGES@)";

/// "package/msg/Name" as a .msg file of ours names it: without "msg", and without our own package.
std::string type_name(const MessageField& field) {
  if (field.nested.starts_with(kMessages)) return field.nested.substr(kMessages.size());
  if (!field.nested.empty()) {
    return field.nested.substr(0, field.nested.find('/')) +
           field.nested.substr(field.nested.rfind('/'));
  }
  if (field.kind == FieldKind::BoundedString) {
    return "string<=" + std::to_string(field.string_capacity);
  }
  return std::string(std::ranges::find(kBasicTypes, field.kind, &BasicType::kind)->msg);
}

std::string count_suffix(const MessageField& field) {
  switch (field.count) {
    case FieldCount::One:
      return "";
    case FieldCount::Array:
      return "[" + std::to_string(field.capacity) + "]";
    case FieldCount::Sequence:
      return "[]";
  }
  return "";
}

template <class Infos>
std::string listed(const Infos& infos, const std::string& name) {
  const auto info = std::ranges::find_if(infos, [&](const auto& i) { return i.name == name; });
  if (info == infos.end()) return {};
  const std::string unit = info->unit.empty() ? "" : " [" + std::string(info->unit) + "]";
  return std::string(info->description) + unit;
}

/// What a field means. Of signals and health figures their lists tell, not the IDL. ROS 2 takes
/// what stands in brackets for the unit.
std::string meaning(const MessageType& type, const MessageField& field) {
  if (type.name == std::string(kMessages) + "Signals") return listed(signals::kSignals, field.name);
  if (type.name == std::string(kMessages) + "Health") return listed(kHealthFigures, field.name);
  return field.comment;
}

std::string filled(std::string_view form, std::string_view place, std::string_view text) {
  std::string whole(form);
  return whole.replace(whole.find(place), place.size(), text);
}

}  // namespace

std::string msg_text(const MessageType& type) {
  std::string text;
  for (const std::string& line : type.comment) text += "# " + line + "\n";
  if (!text.empty()) text += "\n";
  for (const MessageField& field : type.fields) {
    text += type_name(field) + count_suffix(field) + " " + field.name;
    const std::string comment = meaning(type, field);
    text += (comment.empty() ? "" : "  # " + comment) + "\n";
  }
  return text;
}

Result<std::vector<PackageFile>> message_package() {
  const auto& types = message_types();
  if (!types) return tl::unexpected(types.error());
  std::vector<PackageFile> files;
  std::string list, table;
  for (const auto& [name, type] : *types) {
    if (!name.starts_with(kMessages)) continue;
    const std::string file = name.substr(kMessages.size()) + ".msg";
    files.push_back({"msg/" + file, msg_text(type)});
    list += "  \"msg/" + file + "\"\n";
    table.append("| [").append(file).append("](").append(file).append(") |");
    for (const std::string& line : type.comment) table.append(" ").append(line);
    table += " |\n";
  }
  files.push_back({"msg/README.md", filled(kReadme, "@MESSAGES@", table)});
  files.push_back({"CMakeLists.txt", filled(kCMakeLists, "@FILES@", list)});
  files.push_back({"package.xml", filled(kPackageXml, "@VERSION@", ORBWATCH_VERSION)});
  return files;
}

}  // namespace orbwatch::app
