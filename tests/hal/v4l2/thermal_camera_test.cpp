// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "hal/v4l2/device/v4l2_list.h"
#include "hal/v4l2/v4l2_camera.h"
#include "tests/hal/v4l2/drivers/camera_run.h"
#include "tests/hal/v4l2/fake_device.h"

namespace orbwatch::hal {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using tests::FakeDevice;
using tests::kFakeDevice;

/// Picture with 0x80 as chroma above as many rows of words; each word is its place in the frame.
void draw_stacked(std::span<std::uint16_t> words, std::size_t width) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const bool is_picture = i < words.size() / 2;
    words[i] = static_cast<std::uint16_t>(is_picture ? 0x8000 : 1000 + i / width);
  }
}

/// Draws words that contain their row.
void draw_rows(std::span<std::uint16_t> words, std::size_t width) {
  for (std::size_t i = 0; i < words.size(); ++i) words[i] = static_cast<std::uint16_t>(i / width);
}

const FakeDevice kStacked{V4L2_PIX_FMT_YUYV, {{256, 192}, {256, 384}}, draw_stacked};
const FakeDevice kTelemetryOnly{V4L2_PIX_FMT_Y16, {{160, 122}}, draw_rows};

V4l2Settings words(int frame_height, int first_row) {
  return {.device = kFakeDevice,
          .pixel_format = "y16",
          .colour = true,
          .frame_height = frame_height,
          .first_row = first_row,
          .is_radiometric = true};
}

/// First and last row's words of the next frame in the requested size.
std::pair<int, int> rows_of(const V4l2Settings& settings, int width, int height) {
  CameraRun run(settings);
  if (!run.start({.width = width, .height = height})) return {};
  EXPECT_EQ(run.format().format, PixelFormat::Y16);
  EXPECT_EQ(run.format().width, width);
  EXPECT_EQ(run.format().height, height);
  const Frame frame = run.next_frame();
  if (!frame) return {};
  const auto samples = frame->picture.samples<const std::uint16_t>();
  EXPECT_EQ(samples.height, height);
  return {*samples.at(0, 0), *samples.at(width - 1, height - 1)};
}

TEST(ThermalCamera, WordsThatAreCalledYuyvAreReadWhereItIsRadiometric) {
  tests::connect(kStacked);
  EXPECT_EQ(rows_of(words(0, 0), 256, 384), std::pair(0x8000, 1383));
}

TEST(ThermalCamera, APictureIsCutOutOfHigherFrames) {
  tests::connect(kStacked);
  EXPECT_EQ(rows_of(words(384, 192), 256, 192), std::pair(1192, 1383));
  EXPECT_EQ(rows_of(words(384, 200), 256, 100), std::pair(1200, 1299));
}

TEST(ThermalCamera, TelemetryIsCutOffAboveAndBelow) {
  tests::connect(kTelemetryOnly);
  EXPECT_EQ(rows_of(words(122, 0), 160, 120), std::pair(0, 119));
  EXPECT_EQ(rows_of(words(122, 2), 160, 120), std::pair(2, 121));
}

TEST(ThermalCamera, WithoutAHeightThePictureIsTheRestOfTheFrame) {
  tests::connect(kStacked);
  const auto format = V4l2Camera(words(384, 192)).configure({});
  ASSERT_TRUE(format) << format.error().message;
  EXPECT_EQ(format->height, 192);
}

std::string refusal(const V4l2Settings& settings, const StreamRequest& request) {
  const auto format = V4l2Camera(settings).configure(request);
  return format ? std::string() : format.error().message;
}

TEST(ThermalCamera, ARefusalSaysHowItIsConfigured) {
  tests::connect(kStacked);
  V4l2Settings plain = words(0, 0);
  plain.is_radiometric = false;
  EXPECT_THAT(refusal(plain, {.width = 256, .height = 384}),
              AllOf(HasSubstr("YUYV 256x192, 256x384"), HasSubstr("kelvin_per_count")));
  EXPECT_THAT(refusal(words(0, 0), {.width = 256, .height = 190}),
              AllOf(HasSubstr("frame_height and first_row"), Not(HasSubstr("kelvin_per_count"))));
  EXPECT_THAT(refusal(words(384, 200), {.width = 256, .height = 192}),
              HasSubstr("y16 256x192 from row 200 of 384"));
  tests::connect(kTelemetryOnly);
  EXPECT_THAT(refusal(words(0, 0), {.width = 160, .height = 120}), HasSubstr("frame_height"));
}

TEST(ThermalCamera, AMosaicIsCutBetweenItsPatternsOnly) {
  tests::connect({V4L2_PIX_FMT_SRGGB16, {{64, 66}}, draw_rows});
  V4l2Settings mosaic = words(66, 2);
  mosaic.pixel_format = "rggb16";
  EXPECT_EQ(refusal(mosaic, {.width = 64, .height = 64}), "");
  mosaic.first_row = 1;
  EXPECT_NE(refusal(mosaic, {.width = 64, .height = 64}), "");
}

TEST(ThermalCamera, ItsListSaysHowItIsConfigured) {
  tests::connect(kStacked);
  EXPECT_EQ(describe(V4l2Device::open(kFakeDevice).value()).advice,
            "256x384 may be a picture above 16 bit words of temperature: [[camera]] width = 256, "
            "height = 192, kelvin_per_count of the data sheet; [camera.v4l2] pixel_format = "
            "\"y16\", frame_height = 384, first_row = 192");
  tests::connect(kTelemetryOnly);
  EXPECT_EQ(describe(V4l2Device::open(kFakeDevice).value()).advice,
            "160x122 has 2 lines of telemetry: [[camera]] width = 160, height = 120; "
            "[camera.v4l2] frame_height = 122, and first_row = 2 if they are at the top");
  tests::connect({V4L2_PIX_FMT_Y16, {{160, 120}, {160, 122}}, draw_rows});
  EXPECT_EQ(describe(V4l2Device::open(kFakeDevice).value()).advice,
            "160x122 has 2 lines of telemetry: [[camera]] width = 160, height = 120");
  tests::connect({V4L2_PIX_FMT_YUYV, {{640, 480}, {1280, 720}, {320, 180}}, draw_rows});
  EXPECT_EQ(describe(V4l2Device::open(kFakeDevice).value()).advice, "");
}

}  // namespace
}  // namespace orbwatch::hal
