// SPDX-License-Identifier: Apache-2.0
#include "hal/recording/camera_stream.h"

#include <gtest/gtest.h>

#include <string>

/// Metadata of a channel, which has the facts that the messages of ROS 2 do not have.
namespace orbwatch::hal::recording {
namespace {

std::string metadata_refusal(const mcap::StringMap& metadata) {
  StreamFormat format;
  const auto read = read_metadata(metadata, format);
  return read ? "accepted" : read.error().message;
}

TEST(CameraStream, ReturnsFromMetadata) {
  for (const PixelFormatInfo& facts : kPixelFormats) {
    for (const ColourSpace space : {ColourSpace{ColourMatrix::Bt601, ColourRange::Limited},
                                    ColourSpace{ColourMatrix::Bt709, ColourRange::Full}}) {
      const StreamFormat written{facts.format, space, 640, 512, 1e3 / 33.3, 0.1 / 3, 273.15};
      StreamFormat read;
      ASSERT_TRUE(read_metadata(metadata_of(written), read));
      EXPECT_EQ(read.format, written.format);
      EXPECT_EQ(read.colour_space.matrix, space.matrix);
      EXPECT_EQ(read.colour_space.range, space.range);
      EXPECT_EQ(read.frame_rate, written.frame_rate);
      EXPECT_EQ(read.kelvin_per_count, written.kelvin_per_count);
      EXPECT_EQ(read.kelvin_offset, written.kelvin_offset);
      EXPECT_EQ(read.width, 0) << "the sides are those of camera_info";
    }
  }
}

TEST(CameraStream, WithoutEntriesNothingChanges) {
  StreamFormat format{PixelFormat::Y16, {}, 640, 512, 25, 0.04, 0};
  ASSERT_TRUE(read_metadata({{"offered_qos_profiles", ""}}, format));
  EXPECT_EQ(format.format, PixelFormat::Y16);
  EXPECT_EQ(format.frame_rate, 25);
  EXPECT_EQ(format.kelvin_per_count, 0.04);
}

TEST(CameraStream, WrongValuesAreRefused) {
  EXPECT_EQ(metadata_refusal({{"frame_rate", "30"}}), "accepted");
  EXPECT_EQ(metadata_refusal({{"colour_range", "wide"}}),
            "metadata of the channel: colour_range must be one of limited, full");
  for (const char* rate : {"1001", "-1001", "nan", "inf", "1e400", "30 ", "", "0x10"}) {
    EXPECT_EQ(metadata_refusal({{"frame_rate", rate}}),
              "metadata of the channel: frame_rate must be a number of at most 1000.000000")
        << rate;
  }
  StreamFormat format{PixelFormat::Y16, {}, 640, 512, 25, 0.04, 0};
  EXPECT_FALSE(read_metadata({{"frame_rate", "10"}, {"pixel_format", "evil"}}, format));
  EXPECT_EQ(format.frame_rate, 25) << "all or nothing";
}

TEST(CameraStream, TheQualityOfCodedJpegIsOneToHundred) {
  const std::string key(kJpegQuality);
  EXPECT_EQ(jpeg_quality_in({}), std::nullopt);
  EXPECT_EQ(jpeg_quality_in({{"frame_rate", "30"}, {key, "85"}}), 85);
  for (const char* wrong : {"", "0", "101", "90 ", "9e1", "99999999999999"}) {
    EXPECT_EQ(jpeg_quality_in({{key, wrong}}), std::nullopt) << wrong;
  }
}

}  // namespace
}  // namespace orbwatch::hal::recording
