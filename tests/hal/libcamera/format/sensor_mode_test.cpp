// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/format/camera_configuration.h"

#include <gtest/gtest.h>
#include <libcamera/formats.h>

namespace orbwatch::hal {
namespace {

TEST(RawBitDepth, IsThatOfTheSensorNotOfTheMemory) {
  EXPECT_EQ(raw_bit_depth(libcamera::formats::SRGGB8), 8);
  EXPECT_EQ(raw_bit_depth(libcamera::formats::SBGGR10), 10);
  EXPECT_EQ(raw_bit_depth(libcamera::formats::SBGGR10_CSI2P), 10);
  EXPECT_EQ(raw_bit_depth(libcamera::formats::SGRBG12_CSI2P), 12);
  EXPECT_EQ(raw_bit_depth(libcamera::formats::SGBRG16), 16);
  EXPECT_EQ(raw_bit_depth(libcamera::formats::R8), 8);
  EXPECT_EQ(raw_bit_depth(libcamera::formats::R10), 10);
}

TEST(RawBitDepth, IsNoneOfProcessedFormats) {
  for (const auto& format :
       {libcamera::formats::RGB565, libcamera::formats::RGB888, libcamera::formats::NV12,
        libcamera::formats::RGBA8888, libcamera::formats::MJPEG, libcamera::PixelFormat()}) {
    EXPECT_EQ(raw_bit_depth(format), 0) << format.toString();
  }
}

TEST(SensorMode, IsSetByAnyOfItsParts) {
  EXPECT_FALSE(SensorMode{}.is_set());
  EXPECT_TRUE((SensorMode{0, 0, 10}).is_set());
  EXPECT_EQ(to_text(SensorMode{1640, 1232, 10}), "1640x1232 10 bit");
}

/// Validated configuration that a pipeline might return.
class FixedConfiguration : public libcamera::CameraConfiguration {
 public:
  Status validate() override { return Valid; }
};

TEST(HasSensorMode, IsFalseWhereThePipelineTookNone) {
  FixedConfiguration configuration;
  configuration.addConfiguration(libcamera::StreamConfiguration());
  EXPECT_TRUE(has_sensor_mode(configuration, {}));
  EXPECT_FALSE(has_sensor_mode(configuration, {1640, 1232, 10}));
}

}  // namespace
}  // namespace orbwatch::hal
