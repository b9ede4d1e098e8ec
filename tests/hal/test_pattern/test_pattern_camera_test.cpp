// SPDX-License-Identifier: Apache-2.0
#include "hal/test_pattern/test_pattern_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <string>

#include "hal/test_pattern/painted_number.h"

namespace orbwatch::hal {
namespace {

constexpr int kWidth = 64, kHeight = 48;

/// Frame `number` of a camera that paints the numbers if `numbered`.
Frame frame_of(PixelFormat format, std::uint64_t number = 0, bool numbered = false) {
  TestPatternCamera camera({.name = "test", .pixel_format = format, .numbered = numbered});
  const auto configured = camera.configure({.width = kWidth, .height = kHeight});
  EXPECT_TRUE(configured) << configured.error().message;
  EXPECT_EQ(configured->frame_rate, kTestPatternRate);
  std::promise<Frame> promise;
  bool done = false;
  EXPECT_TRUE(camera.start(
      [&](Frame frame) {
        if (frame->metadata.sequence < number) return;
        if (!std::exchange(done, true)) promise.set_value(std::move(frame));
      },
      [](const FaultReport&) { ADD_FAILURE(); }));
  Frame frame = promise.get_future().get();
  camera.stop();
  return frame;
}

TEST(TestPattern, DeliversEveryFormat) {
  for (const PixelFormatInfo& format : kPixelFormats) {
    const Frame frame = frame_of(format.format);
    EXPECT_EQ(frame->picture.format, format.format);
    EXPECT_EQ(frame->picture.width, kWidth);
    EXPECT_EQ(frame->picture.height, kHeight);
  }
}

TEST(TestPattern, ShowsABrightDiscOnANoisyGround) {
  const Frame frame = frame_of(PixelFormat::Y16);
  const auto samples = frame->picture.samples<std::uint16_t>();
  EXPECT_GT(samples.row(kHeight / 2)[kWidth / 2] * 0.04 - 273.15, 1400) << "degC";
  const auto* ground = samples.row(0);
  EXPECT_LT(*std::max_element(ground, ground + kWidth) * 0.04 - 273.15, 100);
  EXPECT_NE(*std::min_element(ground, ground + kWidth), *std::max_element(ground, ground + kWidth));
}

TEST(TestPattern, PaintsTheNumberThatAFrameHas) {
  for (const std::uint64_t asked : {0, 5}) {
    const Frame frame = frame_of(PixelFormat::Grey, asked, true);
    // Squares of one pixel: 16 of the number, 16 of its complement.
    ASSERT_EQ(number_square(kWidth, kHeight), 1);
    const auto* row = frame->picture.samples<std::uint8_t>().row(kHeight / 2 + kHeight / 20);
    std::uint32_t bits = 0;
    for (int x = 0; x < 2 * kNumberBits; ++x) {
      bits = bits << 1 | (row[(kWidth - 2 * kNumberBits) / 2 + x] > 110 ? 1 : 0);
    }
    EXPECT_EQ(bits >> 16, frame->metadata.sequence);
    EXPECT_EQ(bits & 0xffff, ~frame->metadata.sequence & 0xffff);
  }
  for (const PixelFormatInfo& format : kPixelFormats) frame_of(format.format, 0, true);
}

TEST(TestPattern, HasNoCaptureToCount) {
  TestPatternCamera camera({.name = "test"});
  ASSERT_TRUE(camera.configure({.width = 8, .height = 8}));
  std::promise<void> delivered;
  bool done = false;
  ASSERT_TRUE(camera.start(
      [&](const Frame&) {
        if (!std::exchange(done, true)) delivered.set_value();
      },
      [](const FaultReport&) {}));
  delivered.get_future().wait();
  EXPECT_EQ(camera.capture_time().count(), 0);
}

TEST(TestPattern, RefusesSizesThatTheFormatCannotHave) {
  TestPatternCamera camera({.name = "test", .pixel_format = PixelFormat::Nv12});
  EXPECT_FALSE(camera.configure({}));
  const auto odd = camera.configure({.width = 63, .height = 48});
  ASSERT_FALSE(odd);
  EXPECT_NE(odd.error().message.find("63x48 of nv12"), std::string::npos) << odd.error().message;
}

}  // namespace
}  // namespace orbwatch::hal
