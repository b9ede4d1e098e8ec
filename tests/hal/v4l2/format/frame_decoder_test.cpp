// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/format/frame_decoder.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <algorithm>
#include <string>
#include <vector>

namespace orbwatch::hal {
namespace {

constexpr int kWidth = 16;
constexpr int kHeight = 8;

NegotiatedFormat format(std::uint32_t fourcc, bool colour, std::uint32_t stride) {
  DriverFormat format;
  format.width = kWidth;
  format.height = kHeight;
  format.memory[0].stride = stride;
  const PixelCoding& coding = *find_coding(fourcc);
  return {coding,
          driver_layout(coding, format),
          {frame_format(coding, colour), {}, kWidth, kHeight, 0}};
}

/// Rows in the packing of Y10P: red pixels 1000, green 500, blue 100, with padding.
std::vector<std::byte> packed_mosaic(std::size_t stride) {
  std::vector<std::byte> memory(stride * kHeight, std::byte{0xee});
  for (std::size_t y = 0; y < kHeight; ++y) {
    const std::array<unsigned, 2> pair =
        y % 2 == 0 ? std::array{1000U, 500U} : std::array{500U, 100U};
    for (std::size_t group = 0; group < kWidth / 4; ++group) {
      std::byte* const bytes = memory.data() + y * stride + 5 * group;
      for (std::size_t i = 0; i < 4; ++i) bytes[i] = static_cast<std::byte>(pair[i % 2] >> 2);
      bytes[4] = static_cast<std::byte>((pair[0] & 3U) * 0x11 | (pair[1] & 3U) * 0x44);
    }
  }
  return memory;
}

/// JPEG picture of that size.
std::vector<std::byte> grey_jpeg() {
  const std::vector<unsigned char> grey(std::size_t{kWidth} * kHeight, 100);
  tjhandle encoder = tjInitCompress();
  unsigned char* file = nullptr;
  unsigned long size = 0;
  tjCompress2(encoder, grey.data(), kWidth, 0, kHeight, TJPF_GRAY, &file, &size, TJSAMP_GRAY, 90,
              0);
  const auto* const first = reinterpret_cast<const std::byte*>(file);
  std::vector<std::byte> jpeg(first, first + size);
  tjFree(file);
  tjDestroy(encoder);
  return jpeg;
}

TEST(FrameDecoder, UnpacksAMosaicThatStaysOne) {
  const auto agreed = format(V4L2_PIX_FMT_SRGGB10P, false, 23);
  ASSERT_FALSE(agreed.is_zero_copy());
  FrameDecoder decoder(agreed, 1);
  const auto memory = packed_mosaic(23);
  const auto frame = decoder.decode(memory);
  ASSERT_TRUE(frame && *frame);
  ASSERT_EQ((*frame)->picture.format, PixelFormat::Y10);
  const auto samples = (*frame)->picture.samples<const std::uint16_t>();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      EXPECT_EQ(*samples.at(x, y), x % 2 + y % 2 == 0 ? 1000 : x % 2 + y % 2 == 1 ? 500 : 100);
    }
  }
}

TEST(FrameDecoder, MakesColourOfAPackedMosaic) {
  FrameDecoder decoder(format(V4L2_PIX_FMT_SRGGB10P, true, 23), kFreeRunningBuffers);
  const auto memory = packed_mosaic(23);
  const auto frame = decoder.decode(memory);
  ASSERT_TRUE(frame && *frame);
  ASSERT_EQ((*frame)->picture.format, PixelFormat::Bgr);
  const auto samples = (*frame)->picture.samples<const std::uint8_t>();
  for (int y = 0; y < kHeight; ++y) {
    for (int x = 0; x < kWidth; ++x) {
      EXPECT_EQ(samples.at(x, y)[0], 100 >> 2);
      EXPECT_EQ(samples.at(x, y)[1], 500 >> 2);
      EXPECT_EQ(samples.at(x, y)[2], 1000 >> 2);
    }
  }
}

TEST(FrameDecoder, HasNoFrameWhileAllAreInUse) {
  FrameDecoder decoder(format(V4L2_PIX_FMT_Y16_BE, true, 2 * kWidth), kFreeRunningBuffers);
  const std::vector<std::byte> memory(std::size_t{2} * kWidth * kHeight, std::byte{1});
  std::vector<std::shared_ptr<FrameBuffer>> held;
  for (std::size_t n = 0; n < kFreeRunningBuffers; ++n) {
    held.push_back(decoder.decode(memory).value());
    ASSERT_TRUE(held.back());
  }
  EXPECT_EQ(decoder.decode(memory).value(), nullptr);
  held.pop_back();
  EXPECT_NE(decoder.decode(memory).value(), nullptr);
}

TEST(FrameDecoder, GivesTheBufferOfADamagedPictureBack) {
  FrameDecoder decoder(format(V4L2_PIX_FMT_MJPEG, true, 0), kFreeRunningBuffers);
  const std::vector<std::byte> garbage(100, std::byte{0x5a});
  for (std::size_t n = 0; n < 2 * kFreeRunningBuffers; ++n) {
    EXPECT_FALSE(decoder.decode(garbage)) << "an error, not a lack of buffers";
  }
}

TEST(FrameDecoder, AJpegPictureLargerThanAnnouncedIsRefusedWhereItsDataIsKept) {
  auto small = format(V4L2_PIX_FMT_MJPEG, true, 0);
  const auto jpeg = grey_jpeg();
  small.layout.largest = jpeg.size() - 1;
  FrameDecoder decoder(small, 1, true);
  const auto refused = decoder.decode(jpeg);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("the driver announced"), std::string::npos);
  auto larger = small;
  larger.layout.largest = jpeg.size();
  decoder.follow(larger);
  const auto frame = decoder.decode(jpeg);
  ASSERT_TRUE(frame && *frame);
  EXPECT_TRUE(std::ranges::equal((*frame)->jpeg, jpeg));
  EXPECT_TRUE(FrameDecoder(small, 1).decode(jpeg)) << "nothing is kept";
}

TEST(NegotiatedFormat, HandsOnWhatThePipelineReads) {
  EXPECT_TRUE(format(V4L2_PIX_FMT_NV12, true, kWidth).is_zero_copy());
  EXPECT_TRUE(format(V4L2_PIX_FMT_SRGGB8, false, kWidth).is_zero_copy());
  EXPECT_FALSE(format(V4L2_PIX_FMT_SRGGB8, true, kWidth).is_zero_copy());
  EXPECT_FALSE(format(V4L2_PIX_FMT_MJPEG, true, 0).is_zero_copy());
  EXPECT_FALSE(format(V4L2_PIX_FMT_Y16_BE, true, 2 * kWidth).is_zero_copy());
}

}  // namespace
}  // namespace orbwatch::hal
