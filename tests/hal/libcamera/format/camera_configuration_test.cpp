// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/format/camera_configuration.h"

#include <gtest/gtest.h>
#include <libcamera/control_ids.h>

namespace orbwatch::hal {
namespace {

libcamera::StreamConfiguration stream(libcamera::PixelFormat format, unsigned width,
                                      unsigned height) {
  libcamera::StreamConfiguration configuration;
  configuration.pixelFormat = format;
  configuration.size = libcamera::Size(width, height);
  return configuration;
}

TEST(Difference, IsFoundInEachFieldThatWasAskedFor) {
  const auto asked = stream(libcamera::formats::BGR888, 640, 480);
  EXPECT_EQ(difference(asked, asked), std::nullopt);
  EXPECT_EQ(difference(asked, stream(libcamera::formats::BGR888, 636, 480)),
            "BGR888 640x480 would become BGR888 636x480");
  EXPECT_EQ(difference(asked, stream(libcamera::formats::BGR888, 640, 476)),
            "BGR888 640x480 would become BGR888 640x476");
  EXPECT_EQ(difference(asked, stream(libcamera::formats::RGB888, 640, 480)),
            "BGR888 640x480 would become RGB888 640x480");
}

TEST(Difference, LeavesBuffersStrideAndColourSpaceToLibcamera) {
  const auto asked = stream(libcamera::formats::NV12, 640, 480);
  auto given = asked;
  given.stride = 1024;
  given.bufferCount = 3;
  given.colorSpace = libcamera::ColorSpace::Rec709;
  EXPECT_EQ(difference(asked, given), std::nullopt);
}

TEST(PutFrameRate, FixesTheFrameDuration) {
  libcamera::ControlList controls(libcamera::controls::controls);
  put_frame_rate(0, controls);
  EXPECT_TRUE(controls.empty());
  put_frame_rate(29.97, controls);
  const auto limits = controls.get(libcamera::controls::FrameDurationLimits);
  ASSERT_TRUE(limits);
  EXPECT_EQ((*limits)[0], 33367);  // us: 1e6 / 29.97 = 33366.7
  EXPECT_EQ((*limits)[1], 33367);
}

}  // namespace
}  // namespace orbwatch::hal
