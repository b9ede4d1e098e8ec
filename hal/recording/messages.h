// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// Messages of pictures in recordings, member by member as in ROS 2, for hal/mcap/cdr.h.
namespace orbwatch::hal::recording {

/// std_msgs/msg/Header.
struct Header {
  std::int32_t sec = 0;  ///< UTC since 1970
  std::uint32_t nanosec = 0;
  std::string frame_id;  ///< name of the camera

  bool operator==(const Header&) const = default;
  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.sec, self.nanosec, self.frame_id);
  }
};

/// Header of a moment, nanoseconds of UTC since 1970 (until 2038).
inline Header header_at(std::uint64_t nanoseconds, std::string frame_id) {
  constexpr std::uint64_t kSecond = 1'000'000'000;
  return {static_cast<std::int32_t>(nanoseconds / kSecond),
          static_cast<std::uint32_t>(nanoseconds % kSecond), std::move(frame_id)};
}

/// Moment of a header, nanoseconds of UTC since 1970; nullopt: before 1970, or more than a second
/// of nanoseconds.
inline std::optional<std::uint64_t> stamp_of(const Header& header) {
  constexpr std::uint32_t kSecond = 1'000'000'000;
  if (header.sec < 0 || header.nanosec >= kSecond) return std::nullopt;
  return static_cast<std::uint64_t>(header.sec) * kSecond + header.nanosec;
}

/// sensor_msgs/msg/Image.
struct Image {
  static constexpr std::string_view kType = "sensor_msgs/msg/Image";
  Header header;
  std::uint32_t height = 0, width = 0;
  std::string encoding;           ///< see encoding_of()
  std::uint8_t is_bigendian = 0;  ///< byte order of 16-bit samples
  std::uint32_t step = 0;         ///< bytes from row to row of the first plane
  std::span<const std::byte> data;

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.header, self.height, self.width, self.encoding, self.is_bigendian, self.step,
                  self.data);
  }
};

/// sensor_msgs/msg/CompressedImage.
struct CompressedImage {
  static constexpr std::string_view kType = "sensor_msgs/msg/CompressedImage";
  Header header;
  std::string format;  ///< see kColourJpeg
  std::span<const std::byte> data;

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.header, self.format, self.data);
  }
};

/// Values of CompressedImage::format for JPEG, as defined by ROS' image_transport.
inline constexpr std::string_view kColourJpeg = "rgb8; jpeg compressed bgr8",
                                  kGreyJpeg = "mono8; jpeg compressed mono8";
/// Format of JPEG data that a camera sent, of any colours.
inline constexpr std::string_view kReceivedJpeg = "jpeg";

/// sensor_msgs/msg/RegionOfInterest.
struct RegionOfInterest {
  std::uint32_t x_offset = 0, y_offset = 0, height = 0, width = 0;  ///< all 0: the whole picture
  bool do_rectify = false;

  bool operator==(const RegionOfInterest&) const = default;
  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.x_offset, self.y_offset, self.height, self.width, self.do_rectify);
  }
};

/// sensor_msgs/msg/CameraInfo.
struct CameraInfo {
  static constexpr std::string_view kType = "sensor_msgs/msg/CameraInfo";
  Header header;
  std::uint32_t height = 0, width = 0;  ///< sides of the camera's whole picture
  std::string distortion_model;
  std::vector<double> d;
  std::array<double, 9> k{};  ///< all 0: not calibrated
  std::array<double, 9> r{};
  std::array<double, 12> p{};
  std::uint32_t binning_x = 0, binning_y = 0;
  RegionOfInterest roi;  ///< part of the whole picture that the images show

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.header, self.height, self.width, self.distortion_model, self.d, self.k,
                  self.r, self.p, self.binning_x, self.binning_y, self.roi);
  }
};

/// First members of orbwatch_msgs/msg/ProcessState, whose log_time is that of the pictures of its
/// frame set.
struct SetNumbers {
  static constexpr std::string_view kType = "orbwatch_msgs/msg/ProcessState";
  Header header;
  std::uint64_t frame_set = 0;
  std::uint64_t trigger = 0;  ///< 0: not triggered

  template <class Self, class Fields>
  static auto visit(Self& self, Fields& fields) {
    return fields(self.header, self.frame_set, self.trigger);
  }
};

}  // namespace orbwatch::hal::recording
