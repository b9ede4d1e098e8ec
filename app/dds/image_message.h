#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "app/dds/idl/image.h"
#include "proc/image/pixel_format.h"
#include "proc/image/result.h"

namespace orbwatch::app {

using ImageMessage = sensor_msgs_msg_dds__Image_;

/// How the pixels of an image message lie in memory (ROS 2, sensor_msgs/image_encodings.hpp).
struct ImageEncoding {
  std::string_view name;  ///< of a literal, so zero-terminated
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

/// That of Rgb, Bgr, Grey or Y16.
constexpr const ImageEncoding& encoding_of(PixelFormat format) {
  return *std::ranges::find(kImageEncodings, format, &ImageEncoding::format);
}

inline constexpr bool kBigEndianHost = std::endian::native == std::endian::big;

/// Width or height beyond which a received image is not believed.
inline constexpr std::uint32_t kMaxImageSide = 16384;

/// A received image whose numbers fit together; the bytes belong to the message it was made from.
struct ReceivedImage {
  ImageEncoding encoding = kRgb8;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::size_t step = 0;  ///< bytes from row to row
  const std::uint8_t* data = nullptr;
  bool swapped = false;  ///< 16-bit samples are in the other byte order than the host's
};

/// Checks a message from the network before any pixel is touched. Errors: unknown encoding, a side
/// of 0 or beyond kMaxImageSide, rows longer than the step, a step that is no whole number of
/// samples, data of another size than step * height.
Result<ReceivedImage> check_image(const ImageMessage& message);

}  // namespace orbwatch::app
