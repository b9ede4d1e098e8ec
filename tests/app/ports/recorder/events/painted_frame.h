// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "hal/frame/frame.h"
#include "hal/sync/frame_set.h"
#include "proc/image/pixel_format.h"

namespace orbwatch::tests {

/// Sample of 16 bit at (x, y) of frame `number` of a camera: different for each.
constexpr std::uint16_t painted(std::uint64_t number, std::size_t camera, int x, int y) {
  std::uint64_t mixed = number * 0x9E3779B97F4A7C15 + camera * 0xD1B54A32D192ED03;
  mixed ^= static_cast<std::uint64_t>(x) * 0x94D049BB133111EB;
  mixed += static_cast<std::uint64_t>(y) * 0xBF58476D1CE4E5B9;
  return static_cast<std::uint16_t>(mixed >> 40);
}

/// Frame of a test camera, with 16-bit luminance that its number paints, or any other format with
/// the bytes of that.
inline hal::Frame painted_frame(std::uint64_t number, std::size_t camera, hal::TimePoint exposure,
                                int width, int height, PixelFormat format = PixelFormat::Y16) {
  auto frame = std::make_shared<hal::FrameBuffer>();
  const auto stride = static_cast<std::size_t>(row_bytes(format, width)) + 8;
  frame->capacity = picture_bytes(format, stride, height);
  frame->storage = std::make_unique<std::byte[]>(frame->capacity);
  const auto picture = MutablePicture::contiguous(format, width, height, frame->storage.get(),
                                                  static_cast<std::ptrdiff_t>(stride));
  if (format == PixelFormat::Y16) {
    const auto samples = picture.samples<std::uint16_t>();
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) samples.row(y)[x] = painted(number, camera, x, y);
    }
  } else {
    // Smooth, so that JPEG keeps it.
    for (std::size_t k = 0; k < frame->capacity; ++k) {
      frame->storage[k] = static_cast<std::byte>(60 + number % 100);
    }
  }
  frame->picture = picture;
  frame->metadata.sequence = number;
  frame->metadata.exposure_start = exposure;
  return frame;
}

}  // namespace orbwatch::tests
