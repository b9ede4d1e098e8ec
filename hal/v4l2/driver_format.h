#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "proc/image/pixel_format.h"

namespace orbwatch::hal {

/// A capture format of V4L2 in one shape for drivers of the single- and of the multi-planar
/// interface. The members' values are V4L2's.
struct DriverFormat {
  /// One stretch of memory of each buffer.
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

/// The matrix and range by which a driver says that its YCbCr was made.
ColourSpace colour_space_of(const DriverFormat& format);

}  // namespace orbwatch::hal
