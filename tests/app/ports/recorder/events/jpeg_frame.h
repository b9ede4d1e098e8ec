// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "app/pictures/jpeg_encoder.h"
#include "tests/app/ports/recorder/events/painted_frame.h"

namespace orbwatch::tests {

/// Data that a camera sends for its frame `number`, Nv12.
inline std::vector<std::byte> sent_jpeg(std::uint64_t number, int width, int height) {
  const hal::Frame frame = painted_frame(number, 0, {}, width, height, PixelFormat::Nv12);
  app::JpegEncoder encoder;
  const auto jpeg = encoder.encode(frame->picture, 75);
  EXPECT_TRUE(jpeg);
  const auto bytes = std::as_bytes(jpeg.value_or(std::span<std::uint8_t>()));
  return {bytes.begin(), bytes.end()};
}

/// A frame that keeps the data that its camera sent.
struct JpegFrame : hal::FrameBuffer {
  std::vector<std::byte> sent;
  hal::Frame decoded;
};

inline hal::Frame jpeg_frame(std::uint64_t number, hal::TimePoint exposure, int width, int height) {
  auto frame = std::make_shared<JpegFrame>();
  frame->decoded = painted_frame(number, 0, exposure, width, height, PixelFormat::Nv12);
  frame->picture = frame->decoded->picture;
  frame->metadata = frame->decoded->metadata;
  frame->sent = sent_jpeg(number, width, height);
  frame->jpeg = frame->sent;
  return frame;
}

}  // namespace orbwatch::tests
