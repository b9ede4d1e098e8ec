// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/v4l2/format/pixel_coding.h"
#include "proc/image/pixel_format.h"

namespace orbwatch::hal {

/// A capture format of V4L2, single- or multi-planar. The members' values are V4L2's.
struct DriverFormat {
  /// One memory plane of each buffer.
  struct Memory {
    std::uint32_t stride = 0;  ///< bytes from row to row of its first plane of samples
    std::uint32_t bytes = 0;
  };

  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t fourcc = 0;
  std::uint32_t field = 0;
  std::uint32_t colorspace = 0;
  std::uint32_t ycbcr_enc = 0;
  std::uint32_t quantization = 0;
  std::size_t memory_count = 1;
  std::array<Memory, kMaxPlanes> memory;
};

/// Matrix and range of the YCbCr that a driver declares.
ColourSpace colour_space_of(const DriverFormat& format);

/// Placement of a picture's planes in the memory planes of a buffer.
struct DriverLayout {
  struct Plane {
    std::size_t memory = 0;  ///< index of the memory plane
    std::size_t offset = 0;  ///< offset from the memory plane's first sample, bytes
    std::size_t stride = 0;  ///< bytes from row to row
  };

  std::size_t plane_count = 0;
  std::array<Plane, kMaxPlanes> planes;
  std::size_t memory_count = 0;
  std::array<std::size_t, kMaxPlanes> needed{};  ///< bytes of a complete picture, by memory plane
  std::size_t largest = 0;                       ///< most bytes of a frame in the first one
};

/// Layout of a coding in a format that the driver accepted. JPEG pictures have one plane without
/// rows.
DriverLayout driver_layout(const PixelCoding& coding, const DriverFormat& format);

}  // namespace orbwatch::hal
