// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <string_view>

#include "app/ports/dds/generated/compressed_image.h"
#include "app/ports/dds/generated/image.h"
#include "proc/image/pixel_format.h"

namespace orbwatch::app::dds {

using ImageMessage = sensor_msgs_msg_dds__Image_;
using CompressedImageMessage = sensor_msgs_msg_dds__CompressedImage_;

/// Memory layout of the pixels of an image message (ROS 2, sensor_msgs/image_encodings.hpp).
struct ImageEncoding {
  std::string_view name;  ///< points to a literal, so zero-terminated
  PixelFormat format;
  std::uint32_t channels;
  std::uint32_t bytes_per_sample;

  constexpr std::uint32_t bytes_per_pixel() const { return channels * bytes_per_sample; }
};

inline constexpr ImageEncoding kRgb8{"rgb8", PixelFormat::Rgb, 3, 1};
inline constexpr ImageEncoding kBgr8{"bgr8", PixelFormat::Bgr, 3, 1};
inline constexpr ImageEncoding kMono8{"mono8", PixelFormat::Grey, 1, 1};
inline constexpr ImageEncoding kMono16{"mono16", PixelFormat::Y16, 1, 2};
inline constexpr std::array kImageEncodings{kRgb8, kBgr8, kMono8, kMono16};

/// The encoding of Rgb, Bgr, Grey or Y16.
constexpr const ImageEncoding& encoding_of(PixelFormat format) {
  return *std::ranges::find(kImageEncodings, format, &ImageEncoding::format);
}

inline constexpr bool kBigEndianHost = std::endian::native == std::endian::big;

/// Values of `format` of a compressed image, defined by ROS' image_transport: the picture's
/// encoding, then codec and encoding of the compressed data. They are literals, so zero-terminated.
inline constexpr std::string_view kColourJpeg = "rgb8; jpeg compressed bgr8";
inline constexpr std::string_view kGreyJpeg = "mono8; jpeg compressed mono8";

}  // namespace orbwatch::app::dds
