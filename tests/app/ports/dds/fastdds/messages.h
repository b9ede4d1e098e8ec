// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

/// ROS 2 messages by their .msg files (common_interfaces, rmw_dds_common, orbwatch_msgs), read with
/// another vendor's CDR library, independent of the product and its IDL.
namespace orbwatch::tests::ros {

struct Time {
  std::int32_t sec = 0;
  std::uint32_t nanosec = 0;

  bool operator==(const Time&) const = default;
};

struct Header {
  Time stamp;
  std::string frame_id;
};

struct Image {
  static constexpr std::string_view kType = "sensor_msgs::msg::dds_::Image_";
  Header header;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::string encoding;
  std::uint8_t is_bigendian = 0;
  std::uint32_t step = 0;
  std::vector<std::uint8_t> data;
};

struct CompressedImage {
  static constexpr std::string_view kType = "sensor_msgs::msg::dds_::CompressedImage_";
  Header header;
  std::string format;
  std::vector<std::uint8_t> data;
};

struct RegionOfInterest {
  std::uint32_t x_offset = 0;
  std::uint32_t y_offset = 0;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  bool do_rectify = false;
};

struct CameraInfo {
  static constexpr std::string_view kType = "sensor_msgs::msg::dds_::CameraInfo_";
  Header header;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::string distortion_model;
  std::vector<double> d;
  std::array<double, 9> k{};
  std::array<double, 9> r{};
  std::array<double, 12> p{};
  std::uint32_t binning_x = 0;
  std::uint32_t binning_y = 0;
  RegionOfInterest roi;
};

struct KeyValue {
  std::string key;
  std::string value;
};

struct DiagnosticStatus {
  std::uint8_t level = 0;  ///< 0 OK, 1 WARN, 2 ERROR, 3 STALE
  std::string name;
  std::string message;
  std::string hardware_id;
  std::vector<KeyValue> values;
};

struct DiagnosticArray {
  static constexpr std::string_view kType = "diagnostic_msgs::msg::dds_::DiagnosticArray_";
  Header header;
  std::vector<DiagnosticStatus> status;
};

struct Figure {
  std::string name;
  double value = 0;
  std::string unit;
  std::string text;
};

struct Component {
  std::string kind;
  std::string name;
  std::vector<Figure> figures;
};

struct ProcessState {
  static constexpr std::string_view kType = "orbwatch_msgs::msg::dds_::ProcessState_";
  Header header;
  std::uint64_t frame_set = 0;
  std::uint64_t trigger = 0;
  std::uint64_t result = 0;
  std::uint16_t recipe = 0;
  std::uint32_t configuration_checksum = 0;
  std::uint8_t system_state = 0;
  std::uint64_t heartbeat = 0;
  std::vector<Component> components;
};

struct Event {
  static constexpr std::string_view kType = "orbwatch_msgs::msg::dds_::Event_";
  Header header;
  std::uint64_t number = 0;
  std::string kind;
  std::string source;
  std::uint8_t severity = 0;
  std::string text;
  std::vector<Figure> figures;
};

/// ROS 2's identifier of a DDS entity: the 16 bytes of its GUID, to which Humble adds 8 zeros.
template <std::size_t size>
using Gid = std::array<std::uint8_t, size>;
inline constexpr std::size_t kGidSize = 16;
inline constexpr std::size_t kHumbleGidSize = 24;

template <std::size_t gid_size>
struct NodeEntitiesInfo {
  std::string node_namespace;
  std::string node_name;
  std::vector<Gid<gid_size>> reader_gids;
  std::vector<Gid<gid_size>> writer_gids;
};

/// Message of the topic ros_discovery_info.
template <std::size_t gid_size>
struct ParticipantEntitiesInfo {
  static constexpr std::string_view kType = "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_";
  Gid<gid_size> gid{};
  std::vector<NodeEntitiesInfo<gid_size>> nodes;
};
using DiscoveryInfo = ParticipantEntitiesInfo<kGidSize>;
using HumbleDiscoveryInfo = ParticipantEntitiesInfo<kHumbleGidSize>;

/// Decodes the message in `cdr`, including encapsulation, in either byte order. Nullopt: truncated,
/// not plain CDR, or followed by more than the padding to a multiple of 4 bytes.
template <class Message>
std::optional<Message> decode(std::span<const std::uint8_t> cdr);

}  // namespace orbwatch::tests::ros
