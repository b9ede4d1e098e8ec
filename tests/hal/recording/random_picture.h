// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "hal/recording/picture_region.h"

namespace orbwatch::tests {

/// A picture of random pixels that owns them.
struct RandomPicture {
  /// `padding`: bytes between rows of the first plane; even for formats of several planes.
  RandomPicture(std::mt19937& random, PixelFormat format, int width, int height, int padding)
      : bytes(picture_bytes(format, static_cast<std::size_t>(row_bytes(format, width) + padding),
                            height)) {
    std::ranges::generate(bytes, [&] { return static_cast<std::byte>(random()); });
    picture = MutablePicture::contiguous(format, width, height, bytes.data(),
                                         row_bytes(format, width) + padding);
  }

  std::vector<std::byte> bytes;
  MutablePicture picture;
};

inline int between(std::mt19937& random, int least, int most) {
  return std::uniform_int_distribution(least, most)(random);
}

/// Sides of 2 to 64, even where pixels share chroma.
inline hal::recording::PictureRegion random_sides(std::mt19937& random, PixelFormat format) {
  return hal::recording::widened({0, 0, between(random, 1, 63), between(random, 1, 63)}, format);
}

/// A region of a picture with these sides that does not split chroma.
inline hal::recording::PictureRegion random_region(std::mt19937& random, PixelFormat format,
                                                   int whole_width, int whole_height) {
  const int width = between(random, 1, whole_width), height = between(random, 1, whole_height);
  return hal::recording::widened({between(random, 0, whole_width - width),
                                  between(random, 0, whole_height - height), width, height},
                                 format);
}

/// All samples of a pixel with those that it shares, plane by plane.
inline std::vector<std::byte> samples_at(const Picture& picture, int x, int y) {
  std::vector<std::byte> samples;
  const PixelFormatInfo& facts = info(picture.format);
  // Packed 4:2:2: the pair of pixels.
  const bool is_pair = picture.format == PixelFormat::Yuyv || picture.format == PixelFormat::Uyvy;
  if (is_pair) x = x / 2 * 2;
  for (std::size_t n = 0; n < facts.plane_count(); ++n) {
    const PlaneInfo& plane = facts.planes[n];
    const int size = plane.samples * facts.bytes_per_sample();
    const std::byte* const at = picture.planes[n].data +
                                (y >> plane.shift_y) * picture.planes[n].stride +
                                (x >> plane.shift_x) * size;
    samples.insert(samples.end(), at, at + (is_pair ? 2 * size : size));
  }
  return samples;
}

inline bool contains(const hal::recording::PictureRegion& region, int x, int y) {
  return x >= region.x && y >= region.y && x < region.x + region.width &&
         y < region.y + region.height;
}

}  // namespace orbwatch::tests
