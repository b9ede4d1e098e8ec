#include "hal/test_pattern/test_pattern_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <string>

namespace orbwatch::hal {
namespace {

constexpr int kWidth = 64, kHeight = 48;

Frame first_frame(PixelFormat format) {
  TestPatternCamera camera({.name = "test", .pixel_format = format});
  const auto configured = camera.configure({.width = kWidth, .height = kHeight});
  EXPECT_TRUE(configured) << configured.error().message;
  EXPECT_EQ(configured->frame_rate, kTestPatternRate);
  std::promise<Frame> promise;
  bool done = false;
  EXPECT_TRUE(camera.start(
      [&](Frame frame) {
        if (!std::exchange(done, true)) promise.set_value(std::move(frame));
      },
      [](const FaultReport&) { ADD_FAILURE(); }));
  Frame frame = promise.get_future().get();
  camera.stop();
  return frame;
}

TEST(TestPattern, DeliversEveryFormat) {
  for (const PixelFormatInfo& format : kPixelFormats) {
    const Frame frame = first_frame(format.format);
    EXPECT_EQ(frame->picture.format, format.format);
    EXPECT_EQ(frame->picture.width, kWidth);
    EXPECT_EQ(frame->picture.height, kHeight);
  }
}

TEST(TestPattern, ShowsABrightDiscOnANoisyGround) {
  const Frame frame = first_frame(PixelFormat::Y16);
  const auto samples = frame->picture.samples<std::uint16_t>();
  EXPECT_GT(samples.row(kHeight / 2)[kWidth / 2] * 0.04 - 273.15, 1400) << "degC";
  const auto* ground = samples.row(0);
  EXPECT_LT(*std::max_element(ground, ground + kWidth) * 0.04 - 273.15, 100);
  EXPECT_NE(*std::min_element(ground, ground + kWidth), *std::max_element(ground, ground + kWidth));
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
