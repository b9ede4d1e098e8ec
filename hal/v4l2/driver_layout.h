#pragma once

#include <array>
#include <cstddef>

#include "hal/v4l2/driver_format.h"
#include "hal/v4l2/pixel_coding.h"

namespace orbwatch::hal {

/// Where a driver puts the planes of a picture in the memory of a buffer.
struct DriverLayout {
  struct Plane {
    std::size_t memory = 0;  ///< which stretch
    std::size_t offset = 0;  ///< from that one's first sample, bytes
    std::size_t stride = 0;  ///< from row to row, bytes
  };

  std::size_t plane_count = 0;
  std::array<Plane, kMaxPlanes> planes;
  std::size_t memory_count = 0;
  std::array<std::size_t, kMaxPlanes> needed{};  ///< bytes of a whole picture, by stretch
};

/// Of a coding in a format that the driver agreed to. JPEG pictures have one plane without rows.
DriverLayout driver_layout(const PixelCoding& coding, const DriverFormat& format);

}  // namespace orbwatch::hal
