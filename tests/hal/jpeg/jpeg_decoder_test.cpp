// SPDX-License-Identifier: Apache-2.0
#include "hal/jpeg/jpeg_decoder.h"

#include <gtest/gtest.h>
#include <turbojpeg.h>

#include <string>

#include "tests/hal/jpeg/jpeg_marker.h"

namespace orbwatch::hal {
namespace {

constexpr int kGradientWidth = 53;  // odd: not a multiple of blocks or pairs
constexpr int kGradientHeight = 37;
constexpr std::size_t kGradientPixels = std::size_t{kGradientWidth} * kGradientHeight;

std::vector<std::uint8_t> gradient() {
  std::vector<std::uint8_t> pixels;
  for (int y = 0; y < kGradientHeight; ++y) {
    for (int x = 0; x < kGradientWidth; ++x) {
      pixels.push_back(static_cast<std::uint8_t>(4 * x));
      pixels.push_back(static_cast<std::uint8_t>(6 * y));
      pixels.push_back(static_cast<std::uint8_t>(2 * (x + y)));
    }
  }
  return pixels;
}

std::vector<std::byte> gradient_jpeg(int flags = 0) {
  const auto pixels = gradient();
  unsigned char* file = nullptr;
  unsigned long size = 0;
  tjhandle encoder = tjInitCompress();
  EXPECT_EQ(tjCompress2(encoder, pixels.data(), kGradientWidth, 0, kGradientHeight, TJPF_RGB, &file,
                        &size, TJSAMP_444, 98, flags),
            0);
  const auto* first = reinterpret_cast<const std::byte*>(file);
  std::vector<std::byte> jpeg(first, first + size);
  tjFree(file);
  tjDestroy(encoder);
  return jpeg;
}

/// JFIF's luminance of the original pixels.
double luminance(std::size_t pixel) {
  static const auto rgb = gradient();
  return 0.299 * rgb[3 * pixel] + 0.587 * rgb[3 * pixel + 1] + 0.114 * rgb[3 * pixel + 2];
}

struct GreyTarget {
  std::vector<std::uint8_t> pixels = std::vector<std::uint8_t>(kGradientPixels);
  ImageView<std::uint8_t> view{pixels.data(), kGradientWidth, kGradientHeight, 1, kGradientWidth};
};

/// Removes one marker segment.
std::vector<std::byte> without_segment(const std::vector<std::byte>& jpeg, int marker) {
  std::vector<std::byte> kept(jpeg.begin(), jpeg.begin() + 2);
  std::size_t at = 2;
  for (;;) {
    const int found = std::to_integer<int>(jpeg[at + 1]);
    const std::size_t length = 2 + std::to_integer<std::size_t>(jpeg[at + 2]) * 256 +
                               std::to_integer<std::size_t>(jpeg[at + 3]);
    const auto begin = jpeg.begin() + static_cast<std::ptrdiff_t>(at);
    if (found == 0xda) {
      kept.insert(kept.end(), begin, jpeg.end());
      return kept;
    }
    if (found != marker)
      kept.insert(kept.end(), begin, begin + static_cast<std::ptrdiff_t>(length));
    at += length;
  }
}

TEST(JpegDecoder, DecodesAWholePicture) {
  JpegDecoder decoder;
  const auto jpeg = gradient_jpeg();
  const auto size = decoder.read_size(jpeg);
  ASSERT_TRUE(size) << size.error().message;
  EXPECT_EQ(size->width, kGradientWidth);
  EXPECT_EQ(size->height, kGradientHeight);
  EXPECT_TRUE(decoder.check(jpeg));
  GreyTarget target;
  const auto done = decoder.decode_packed(jpeg, target.view);
  ASSERT_TRUE(done) << done.error().message;
  for (std::size_t i = 0; i < kGradientPixels; ++i) {
    ASSERT_NEAR(target.pixels[i], luminance(i), 2) << "pixel " << i;
  }
}

TEST(JpegDecoder, DecodesColourAndKnowsGrey) {
  std::vector<std::uint8_t> rgb;
  for (std::size_t i = 0; i < kGradientPixels; ++i) {
    rgb.insert(rgb.end(), {200, 100, 50});
  }
  const auto encoded = [&rgb](int sampling) {
    unsigned char* jpeg = nullptr;
    unsigned long size = 0;
    const tjhandle encoder = tjInitCompress();
    EXPECT_EQ(tjCompress2(encoder, rgb.data(), kGradientWidth, 0, kGradientHeight, TJPF_RGB, &jpeg,
                          &size, sampling, 95, 0),
              0);
    const auto* const first = reinterpret_cast<const std::byte*>(jpeg);
    const std::vector<std::byte> bytes(first, first + size);
    tjFree(jpeg);
    tjDestroy(encoder);
    return bytes;
  };
  JpegDecoder decoder;
  EXPECT_TRUE(decoder.read_size(encoded(TJSAMP_GRAY))->is_grey);
  const auto colour = encoded(TJSAMP_420);
  EXPECT_FALSE(decoder.read_size(colour)->is_grey);
  std::vector<std::uint8_t> pixels(3 * kGradientPixels);
  const auto done = decoder.decode_packed(
      colour, {pixels.data(), kGradientWidth, kGradientHeight, 3, 3 * kGradientWidth});
  ASSERT_TRUE(done) << done.error().message;
  for (std::size_t i = 0; i < pixels.size(); ++i) ASSERT_NEAR(pixels[i], rgb[i], 3) << i;
}

TEST(JpegDecoder, HonoursTheStrideOfItsTarget) {
  JpegDecoder decoder;
  constexpr std::ptrdiff_t kStride = kGradientWidth + 11;
  std::vector<std::uint8_t> pixels(static_cast<std::size_t>(kStride) * kGradientHeight, 0xee);
  ASSERT_TRUE(decoder.decode_packed(gradient_jpeg(),
                                    {pixels.data(), kGradientWidth, kGradientHeight, 1, kStride}));
  GreyTarget packed;
  ASSERT_TRUE(decoder.decode_packed(gradient_jpeg(), packed.view));
  for (int y = 0; y < kGradientHeight; ++y) {
    const auto* row = pixels.data() + y * kStride;
    EXPECT_TRUE(std::equal(row, row + kGradientWidth, packed.view.row(y))) << "row " << y;
    EXPECT_EQ(row[kGradientWidth], 0xee) << "wrote beyond row " << y;
  }
}

TEST(JpegDecoder, DecodesWithoutHuffmanTablesAsUsbCamerasSend) {
  JpegDecoder decoder;
  const auto jpeg = gradient_jpeg();
  const auto bare = without_segment(jpeg, 0xc4);
  ASSERT_LT(bare.size(), jpeg.size() - 400);
  GreyTarget with;
  GreyTarget without;
  ASSERT_TRUE(decoder.decode_packed(jpeg, with.view));
  const auto done = decoder.decode_packed(bare, without.view);
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_EQ(with.pixels, without.pixels);
}

TEST(JpegDecoder, RefusesEveryTruncationOfItsData) {
  for (const int flags : {0, TJFLAG_PROGRESSIVE}) {
    const auto jpeg = gradient_jpeg(flags);
    JpegDecoder decoder;
    GreyTarget target;
    for (std::size_t length = 0; length < jpeg.size() - kMarkerBytes; ++length) {
      const std::span part(jpeg.data(), length);
      ASSERT_FALSE(decoder.decode_packed(part, target.view)) << length << " of " << jpeg.size();
      ASSERT_FALSE(decoder.check(part)) << length << " of " << jpeg.size();
    }
    const auto done = decoder.decode_packed(jpeg, target.view);
    EXPECT_TRUE(done) << "must recover from errors: " << done.error().message;
  }
}

TEST(JpegDecoder, CheckAgreesWithDecodingOnDamagedData) {
  const auto whole = gradient_jpeg();
  JpegDecoder decoder;
  GreyTarget target;
  int refused = 0;
  for (std::size_t at = 0; at < whole.size(); ++at) {
    auto jpeg = whole;
    jpeg[at] ^= std::byte{0x55};
    const auto size = decoder.read_size(jpeg);
    if (!size || size->width != kGradientWidth || size->height != kGradientHeight) continue;
    const bool decoded = decoder.decode_packed(jpeg, target.view).has_value();
    EXPECT_EQ(decoder.check(jpeg).has_value(), decoded) << "byte " << at;
    refused += decoded ? 0 : 1;
  }
  EXPECT_GT(refused, 0);
}

TEST(JpegDecoder, RefusesGarbage) {
  JpegDecoder decoder;
  GreyTarget target;
  const std::vector<std::byte> garbage(5000, std::byte{0x5a});
  EXPECT_FALSE(decoder.read_size({}));
  EXPECT_FALSE(decoder.read_size(garbage));
  EXPECT_FALSE(decoder.check(garbage));
  EXPECT_FALSE(decoder.decode_packed(garbage, target.view));
}

TEST(JpegDecoder, RefusesAnotherSizeAndNamesBoth) {
  JpegDecoder decoder;
  std::vector<std::uint8_t> small(30 * 20);
  const auto done = decoder.decode_packed(gradient_jpeg(), {small.data(), 30, 20, 1, 30});
  ASSERT_FALSE(done);
  EXPECT_NE(done.error().message.find("53x37"), std::string::npos) << done.error().message;
  EXPECT_NE(done.error().message.find("30x20"), std::string::npos) << done.error().message;
}

}  // namespace
}  // namespace orbwatch::hal
