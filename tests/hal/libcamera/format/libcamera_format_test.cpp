// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/format/libcamera_format.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace orbwatch::hal {
namespace {

using testing::HasSubstr;

TEST(LibcameraFormats, AreNamedAsLibcameraDoes) {
  for (const LibcameraFormat& format : kLibcameraFormats) {
    EXPECT_EQ(find_format(format.code), &format) << format.name;
    const auto named = libcamera::PixelFormat::fromString(std::string(format.name));
    // libcamera 0.0.3 has no R16.
    EXPECT_TRUE(!named.isValid() || named == format.code) << format.name;
    EXPECT_TRUE(named.isValid() || format.name == "R16") << format.name;
  }
  EXPECT_EQ(find_format(libcamera::formats::MJPEG), nullptr);
  EXPECT_EQ(find_format(libcamera::formats::SRGGB10), nullptr);
}

/// In drm_fourcc.h RGB888 is [23:0] R:G:B little endian, so B comes first in memory.
TEST(LibcameraFormats, OfColourAreNamedByTheWordNotByTheBytes) {
  EXPECT_EQ(find_format(libcamera::formats::RGB888)->format, PixelFormat::Bgr);
  EXPECT_EQ(find_format(libcamera::formats::BGR888)->format, PixelFormat::Rgb);
  EXPECT_EQ(find_format(libcamera::formats::XRGB8888)->format, PixelFormat::Bgra);
  EXPECT_EQ(find_format(libcamera::formats::XBGR8888), nullptr) << "R first has no format here";
}

TEST(LibcameraColourSpace, IsWhatTheCameraSays) {
  const auto sycc = colour_space_of(libcamera::ColorSpace::Sycc, PixelFormat::Nv12);
  ASSERT_TRUE(sycc);
  EXPECT_EQ(sycc->matrix, ColourMatrix::Bt601);
  EXPECT_EQ(sycc->range, ColourRange::Full);
  const auto rec709 = colour_space_of(libcamera::ColorSpace::Rec709, PixelFormat::Yuyv);
  ASSERT_TRUE(rec709);
  EXPECT_EQ(rec709->matrix, ColourMatrix::Bt709);
  EXPECT_EQ(rec709->range, ColourRange::Limited);
  const auto smpte = colour_space_of(libcamera::ColorSpace::Smpte170m, PixelFormat::I420);
  ASSERT_TRUE(smpte);
  EXPECT_EQ(smpte->matrix, ColourMatrix::Bt601);
  EXPECT_EQ(smpte->range, ColourRange::Limited);
  EXPECT_EQ(colour_space_of(libcamera::ColorSpace::Rec2020, PixelFormat::Nv12), std::nullopt);
  const auto rgb = colour_space_of(libcamera::ColorSpace::Rec2020, PixelFormat::Rgb);
  ASSERT_TRUE(rgb) << "R G B has no matrix";
  EXPECT_EQ(rgb->range, ColourRange::Full);
}

using Bytes = std::span<const std::byte>;

const LibcameraFormat& format(std::string_view name) {
  return *std::find_if(kLibcameraFormats.begin(), kLibcameraFormats.end(),
                       [name](const LibcameraFormat& f) { return f.name == name; });
}

TEST(LayOut, FollowsTheStrideOverPlanesInOneMemory) {
  const std::vector<std::byte> memory(128 * 48 * 3 / 2);
  const Bytes all(memory);
  const Bytes planes[] = {all.first(128 * 48), all.subspan(128 * 48)};
  const auto nv12 = lay_out(format("NV12"), 100, 48, 128, planes);
  ASSERT_TRUE(nv12);
  EXPECT_EQ(nv12->planes[0].stride, 128);
  EXPECT_EQ(nv12->planes[1].stride, 128);
  EXPECT_EQ(nv12->planes[1].data, memory.data() + 128 * 48);
  const auto one = lay_out(format("NV12"), 100, 48, 128, {&all, 1});
  ASSERT_TRUE(one);
  EXPECT_EQ(one->planes[1].data, memory.data() + 128 * 48);
}

TEST(LayOut, FindsPlanesInMemoriesOfTheirOwn) {
  const std::vector<std::byte> y(64 * 32);
  const std::vector<std::byte> first(32 * 16);
  const std::vector<std::byte> second(32 * 16);
  const Bytes planes[] = {y, first, second};
  const auto i420 = lay_out(format("YUV420"), 60, 32, 64, planes);
  ASSERT_TRUE(i420);
  EXPECT_EQ(i420->planes[1].stride, 32);
  EXPECT_EQ(i420->planes[1].data, first.data());
  EXPECT_EQ(i420->planes[2].data, second.data());
  const auto yv12 = lay_out(format("YVU420"), 60, 32, 64, planes);
  ASSERT_TRUE(yv12);
  EXPECT_EQ(yv12->planes[1].data, second.data()) << "U comes last";
  EXPECT_EQ(yv12->planes[2].data, first.data());
}

TEST(LayOut, RefusesShortMemory) {
  const std::vector<std::byte> memory(64 * 32 - 1);
  const Bytes plane(memory);
  const auto grey = lay_out(format("R8"), 64, 32, 64, {&plane, 1});
  ASSERT_FALSE(grey);
  EXPECT_THAT(grey.error().message, HasSubstr("2047 bytes; it takes 2048"));
  EXPECT_FALSE(lay_out(format("R8"), 64, 32, 64, {}));
  const Bytes planes[] = {plane, plane.first(10)};
  EXPECT_FALSE(lay_out(format("NV12"), 60, 30, 64, planes)) << "the second plane";
}

}  // namespace
}  // namespace orbwatch::hal
