// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <span>
#include <vector>

#include "proc/image/picture.h"

namespace orbwatch::tests {

/// A picture with memory of its own, whose rows are `padding` bytes longer than their pixels.
class StoredPicture {
 public:
  StoredPicture(PixelFormat format, int width, int height, int padding = 0) {
    const int stride = row_bytes(format, width) + padding;
    bytes.resize(picture_bytes(format, static_cast<std::size_t>(stride), height));
    picture = MutablePicture::contiguous(format, width, height, bytes.data(), stride);
    source = picture;
  }
  StoredPicture(const StoredPicture&) = delete;
  StoredPicture& operator=(const StoredPicture&) = delete;

  void fill_with_noise(std::uint32_t seed) {
    std::mt19937 random(seed);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random());
  }

  /// The picture as an argument of remap().
  std::span<const Picture> as_source() const { return {&source, 1}; }

  std::uint8_t sample(std::size_t plane, int row, int byte) const {
    return static_cast<std::uint8_t>(
        picture.planes[plane].data[row * picture.planes[plane].stride + byte]);
  }

  std::vector<std::byte> bytes;
  MutablePicture picture;
  Picture source;
};

}  // namespace orbwatch::tests
