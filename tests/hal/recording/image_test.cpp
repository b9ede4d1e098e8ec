// SPDX-License-Identifier: Apache-2.0
#include "hal/recording/image.h"

#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <string>

#include "hal/mcap/cdr.h"
#include "tests/hal/recording/random_picture.h"

/// Pictures as sensor_msgs/msg/Image, compared sample by sample.
namespace orbwatch::hal::recording {
namespace {

using tests::random_sides;
using tests::RandomPicture;
using tests::samples_at;

std::string image_refusal(const Image& message) {
  const auto picture = picture_of(message);
  return picture ? "accepted" : picture.error().message;
}

TEST(Image, PicturesOfEveryFormatReturnFromTheirMessage) {
  std::mt19937 random(36);
  for (int k = 0; k < 100; ++k) {
    for (const PixelFormatInfo& facts : kPixelFormats) {
      const auto sides = random_sides(random, facts.format);
      const RandomPicture source(random, facts.format, sides.width, sides.height,
                                 2 * tests::between(random, 0, 9));
      mcap::Bytes pixels, bytes;
      mcap::encode_cdr(
          image_of(source.picture, header_at(1'700'000'000'123'456'789, "north"), pixels), bytes);
      Image message;
      ASSERT_TRUE(mcap::decode_cdr(bytes, message));
      EXPECT_EQ(message.encoding, encoding_of(facts.format));
      EXPECT_EQ(stamp_of(message.header), 1'700'000'000'123'456'789U);
      const auto read = picture_of(message, facts.format);
      ASSERT_TRUE(read) << facts.name << ": " << read.error().message;
      ASSERT_EQ(read->format, facts.format);
      ASSERT_EQ(read->width, sides.width);
      ASSERT_EQ(read->height, sides.height);
      for (int y = 0; y < sides.height; ++y) {
        for (int x = 0; x < sides.width; ++x) {
          ASSERT_EQ(samples_at(*read, x, y), samples_at(source.picture, x, y))
              << facts.name << " at " << x << "," << y;
        }
      }
    }
  }
}

TEST(Image, HasTheBytesThatRos2Defines) {
  // sensor_msgs/image_encodings.hpp: mono16 is little-endian with is_bigendian 0; step is the
  // length of a row in bytes.
  std::array<std::uint16_t, 6> counts{0x0102, 0x0304, 0x0506, 0x0708, 0x090a, 0x0b0c};
  const auto source =
      picture_of(PixelFormat::Y16, ImageView<std::uint16_t>{counts.data(), 3, 2, 1, 3});
  mcap::Bytes pixels;
  const Image message = image_of(source, {}, pixels);
  EXPECT_EQ(message.encoding, "mono16");
  EXPECT_EQ(message.is_bigendian, 0);
  EXPECT_EQ(message.step, 6U);
  const std::array<unsigned char, 12> expected{2, 1, 4, 3, 6, 5, 8, 7, 10, 9, 12, 11};
  ASSERT_EQ(message.data.size(), expected.size());
  EXPECT_EQ(std::memcmp(message.data.data(), expected.data(), expected.size()), 0);
}

TEST(Image, RowsMayBePadded) {
  std::mt19937 random(37);
  for (const PixelFormatInfo& facts : kPixelFormats) {
    const RandomPicture source(random, facts.format, 8, 6, 4);
    Image message;
    message.width = 8;
    message.height = 6;
    message.encoding = encoding_of(facts.format);
    message.step = static_cast<std::uint32_t>(row_bytes(facts.format, 8) + 4);
    message.data = source.bytes;
    const auto read = picture_of(message, facts.format);
    ASSERT_TRUE(read) << facts.name << ": " << read.error().message;
    EXPECT_EQ(samples_at(*read, 7, 5), samples_at(source.picture, 7, 5)) << facts.name;
  }
}

TEST(Image, OtherNamesOfEncodingsAreRead) {
  const mcap::Bytes data(16);
  const std::map<std::string, PixelFormat> names{{"8UC1", PixelFormat::Grey},
                                                 {"16UC1", PixelFormat::Y16},
                                                 {"yuyv", PixelFormat::Yuyv},
                                                 {"uyvy", PixelFormat::Uyvy}};
  for (const auto& [name, format] : names) {
    Image message{{}, 2, 2, name, 0, static_cast<std::uint32_t>(row_bytes(format, 2)), {}};
    message.data = std::span(data).first(2 * message.step);
    const auto read = picture_of(message);
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->format, format);
  }
}

TEST(Image, WrongMessagesAreRefusedInASentence) {
  const mcap::Bytes data(24);
  const Image good{{}, 3, 4, "mono16", 0, 8, data};
  EXPECT_EQ(image_refusal(good), "accepted");
  const auto with = [&](auto change) {
    Image message = good;
    change(message);
    return image_refusal(message);
  };
  EXPECT_EQ(with([](Image& m) { m.width = 0; }), "image of 0x3: its sides must be 1 to 16384");
  EXPECT_EQ(with([](Image& m) { m.height = 4'000'000'000; }),
            "image of 4x4000000000: its sides must be 1 to 16384");
  EXPECT_EQ(with([](Image& m) { m.is_bigendian = 1; }),
            "image of 4x3: big-endian; samples must be little-endian");
  EXPECT_EQ(with([](Image& m) { m.step = 7; }),
            "image of 4x3: step of 7 bytes; it must be 8 to 262144 and a multiple of 2");
  EXPECT_EQ(with([](Image& m) { m.step = 9; }),
            "image of 4x3: step of 9 bytes; it must be 8 to 262144 and a multiple of 2");
  EXPECT_EQ(with([](Image& m) { m.step = 4'294'967'294; }),
            "image of 4x3: step of 4294967294 bytes; it must be 8 to 262144 and a multiple of 2");
  EXPECT_EQ(with([&](Image& m) { m.data = std::span(data).first(23); }),
            "image of 4x3: 23 bytes of pixels; with a step of 8 there must be 24");
  EXPECT_EQ(with([](Image& m) { m.encoding = "nv12"; }),
            "image of 4x3: its sides must be even where pixels share chroma");
  EXPECT_EQ(with([](Image& m) { m.encoding = "evil\n"; }),
            "image of 4x3: unknown encoding; it must be one of mono8, mono16, yuv422_yuy2, yuv422, "
            "nv12, nv21, i420, rgb8, bgr8, bgra8, rgb16, 8UC1, 16UC1, yuyv, uyvy");
}

}  // namespace
}  // namespace orbwatch::hal::recording
