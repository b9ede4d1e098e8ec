// SPDX-License-Identifier: Apache-2.0
#include "hal/png/png_decoder.h"

#include <gtest/gtest.h>
#include <malloc.h>
#include <zlib.h>

#include <algorithm>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "tests/hal/png/written_png.h"

namespace orbwatch::hal {
namespace {

using tests::PngLayout;
using tests::written_png;

/// A decoded picture, or the reason why there is none.
struct Decoded {
  std::string error;
  PngHeader header;
  std::vector<std::byte> bytes;
  std::string exif;

  int sample(std::size_t index) const {
    const bool is_wide = info(header.format).bits == 16;
    return is_wide ? reinterpret_cast<const std::uint16_t*>(bytes.data())[index]
                   : std::to_integer<int>(bytes[index]);
  }
};

Decoded decoded(std::span<const std::byte> png) {
  PngDecoder decoder;
  const auto header = decoder.open(png);
  if (!header) return {header.error().message, {}, {}, {}};
  const int stride = row_bytes(header->format, header->width);
  Decoded result{"", *header, {}, {}};
  result.bytes.resize(static_cast<std::size_t>(stride * header->height));
  const auto done = decoder.decode(MutablePicture::contiguous(
      header->format, header->width, header->height, result.bytes.data(), stride));
  if (!done) return {done.error().message, {}, {}, {}};
  const auto exif = decoder.exif();
  result.exif.assign(reinterpret_cast<const char*>(exif.data()), exif.size());
  return result;
}

std::string big_endian(std::uint32_t number) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) text += static_cast<char>(number >> shift & 0xff);
  return text;
}

/// A chunk with its length and the right check sum.
std::string png_chunk(const std::string& type, const std::string& data) {
  const std::string summed = type + data;
  const auto sum =
      crc32(0, reinterpret_cast<const Bytef*>(summed.data()), static_cast<uInt>(summed.size()));
  return big_endian(static_cast<std::uint32_t>(data.size())) + summed +
         big_endian(static_cast<std::uint32_t>(sum));
}

std::vector<std::byte> bytes_of(const std::string& text) {
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

/// Random samples of a layout, packed to rows, and what is decoded of them.
class Samples {
 public:
  explicit Samples(const PngLayout& layout) : layout_(layout) {
    for (int y = 0; y < layout.height; ++y) add_row();
  }

  const std::vector<std::vector<std::uint8_t>>& rows() const { return rows_; }
  const std::vector<int>& expected() const { return expected_; }

 private:
  int channels() const {
    const int colours = (layout_.colour_type & PNG_COLOR_MASK_COLOR) != 0 ? 3 : 1;
    const bool is_palette = layout_.colour_type == PNG_COLOR_TYPE_PALETTE;
    return (is_palette ? 1 : colours) + (has_alpha() ? 1 : 0);
  }
  bool has_alpha() const { return (layout_.colour_type & PNG_COLOR_MASK_ALPHA) != 0; }

  void add_row() {
    std::vector<std::uint8_t>& row = rows_.emplace_back();
    int used = 0;  // bits
    for (int i = 0; i < layout_.width * channels(); ++i) {
      const bool is_palette = layout_.colour_type == PNG_COLOR_TYPE_PALETTE;
      const int limit = is_palette ? std::min(4, 1 << layout_.depth) : 1 << layout_.depth;
      const int value = static_cast<int>(random_() % static_cast<unsigned>(limit));
      if (layout_.depth == 16) row.push_back(static_cast<std::uint8_t>(value >> 8));
      if (used % 8 == 0) row.push_back(0);
      if (layout_.depth >= 8) {
        row.back() = static_cast<std::uint8_t>(value);
      } else {
        row.back() |= static_cast<std::uint8_t>(value << (8 - layout_.depth - used % 8));
        used += layout_.depth;
      }
      expect(value, i);
    }
  }

  void expect(int value, int i) {
    if (has_alpha() && i % channels() == channels() - 1) return;
    if (layout_.colour_type == PNG_COLOR_TYPE_PALETTE) {
      const png_color& colour = tests::kPalette[value];
      expected_.insert(expected_.end(), {colour.red, colour.green, colour.blue});
    } else {
      expected_.push_back(layout_.depth < 8 ? value * 255 / ((1 << layout_.depth) - 1) : value);
    }
  }

  PngLayout layout_;
  std::mt19937 random_{7};
  std::vector<std::vector<std::uint8_t>> rows_;
  std::vector<int> expected_;
};

TEST(PngDecoder, ReadsEveryColourTypeAndDepth) {
  const struct {
    int colour_type;
    std::vector<int> depths;
    PixelFormat narrow, wide;
  } cases[] = {
      {PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16}, PixelFormat::Grey, PixelFormat::Y16},
      {PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16}, PixelFormat::Grey, PixelFormat::Y16},
      {PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8}, PixelFormat::Rgb, PixelFormat::Rgb},
      {PNG_COLOR_TYPE_RGB, {8, 16}, PixelFormat::Rgb, PixelFormat::Rgb16},
      {PNG_COLOR_TYPE_RGB_ALPHA, {8, 16}, PixelFormat::Rgb, PixelFormat::Rgb16},
  };
  for (const auto& [colour_type, depths, narrow, wide] : cases) {
    for (const int depth : depths) {
      for (const bool is_interlaced : {false, true}) {
        const PngLayout layout{colour_type, depth, 13, 9, is_interlaced};
        const Samples samples(layout);
        const Decoded picture = decoded(written_png(layout, samples.rows()));
        const auto what = "type " + std::to_string(colour_type) + " depth " +
                          std::to_string(depth) + (is_interlaced ? " interlaced" : "");
        ASSERT_EQ(picture.error, "") << what;
        EXPECT_EQ(picture.header.width, 13) << what;
        EXPECT_EQ(picture.header.height, 9) << what;
        ASSERT_EQ(picture.header.format, depth == 16 ? wide : narrow) << what;
        for (std::size_t i = 0; i < samples.expected().size(); ++i) {
          ASSERT_EQ(picture.sample(i), samples.expected()[i]) << what << " sample " << i;
        }
      }
    }
  }
}

/// A picture of 7x11 with 16 bit.
std::vector<std::byte> some_picture() {
  const PngLayout layout{PNG_COLOR_TYPE_GRAY, 16, 7, 11};
  return written_png(layout, Samples(layout).rows());
}

TEST(PngDecoder, IgnoresWhatFollowsTheEnd) {
  auto png = some_picture();
  const Decoded whole = decoded(png);
  png.resize(png.size() + 100);
  const Decoded followed = decoded(png);
  EXPECT_EQ(followed.error, "");
  EXPECT_EQ(followed.bytes, whole.bytes);
}

TEST(PngDecoder, RefusesEveryTruncation) {
  const auto png = some_picture();
  for (std::size_t length = 0; length < png.size(); ++length) {
    EXPECT_NE(decoded(std::span(png.data(), length)).error, "") << length << " of " << png.size();
  }
}

TEST(PngDecoder, RefusesEveryFlippedBit) {
  const auto whole = some_picture();
  for (std::size_t at = 0; at < whole.size(); ++at) {
    for (int bit = 0; bit < 8; ++bit) {
      auto png = whole;
      png[at] ^= std::byte{1} << bit;
      EXPECT_NE(decoded(png).error, "") << "byte " << at << " bit " << bit;
    }
  }
}

std::string deflated(const std::string& data) {
  std::string out(compressBound(data.size()), '\0');
  uLongf size = out.size();
  EXPECT_EQ(compress(reinterpret_cast<Bytef*>(out.data()), &size,
                     reinterpret_cast<const Bytef*>(data.data()), data.size()),
            Z_OK);
  out.resize(size);
  return out;
}

const std::string kSignature = "\x89PNG\r\n\x1a\n";
const std::string kEnd = png_chunk("IEND", "");

/// Header of a picture of 8 bit grey.
std::string header(std::uint32_t width, std::uint32_t height) {
  return png_chunk("IHDR", big_endian(width) + big_endian(height) + std::string("\x08\0\0\0\0", 5));
}

/// The rows of a picture of 2x2.
const std::string kRows = png_chunk("IDAT", deflated(std::string("\0ab\0cd", 6)));

std::string error_of(const std::string& chunks) {
  testing::internal::CaptureStderr();
  std::string error = decoded(bytes_of(kSignature + chunks)).error;
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(error.find('\n'), std::string::npos);
  return error;
}

TEST(PngDecoder, RefusesWrongChunksWithRightCheckSums) {
  EXPECT_EQ(error_of(header(2, 2) + kRows + kEnd), "");
  EXPECT_NE(error_of(header(2, 2) + kEnd), "") << "no pixels";
  EXPECT_NE(error_of(header(2, 2) + kRows), "") << "no end";
  EXPECT_NE(error_of(kRows + kEnd), "") << "no header";
  EXPECT_NE(error_of(header(2, 2) + header(2, 2) + kRows + kEnd), "") << "two headers";
  EXPECT_NE(error_of(header(0, 2) + kRows + kEnd), "") << "no width";
  EXPECT_NE(error_of(header(0x80000000U, 2) + kRows + kEnd), "") << "width beyond 31 bit";
  EXPECT_NE(error_of(header(2, 3) + kRows + kEnd), "") << "too few rows";
  EXPECT_NE(error_of(header(2, 2) + png_chunk("IDAT", "no zlib stream") + kEnd), "");
  EXPECT_NE(error_of(header(2, 2) + png_chunk("LOUD", "") + kRows + kEnd), "")
      << "an unknown chunk that a reader must know";
  EXPECT_NE(error_of(png_chunk("IHDR", "") + kRows + kEnd), "") << "an empty header";
}

TEST(PngDecoder, SkipsChunksThatItDoesNotNeed) {
  const std::string profile = png_chunk("iCCP", std::string("name\0\0", 6) + "no zlib stream");
  const std::string text =
      png_chunk("zTXt", std::string("key\0\0", 5) + deflated(std::string(1 << 20, ' ')));
  const std::string gamma = png_chunk("gAMA", big_endian(100000));
  EXPECT_EQ(error_of(header(2, 2) + profile + text + gamma + kRows + text + kEnd), "");
}

/// Memory that the program has allocated, written or not.
std::size_t allocated_bytes() {
  const auto allocated = ::mallinfo2();
  return allocated.uordblks + allocated.hblkhd;
}

TEST(PngDecoder, ReadsTheHeaderOfAHugePictureWithoutMemoryForIt) {
  constexpr int kWide = 0x3a000008;
  const auto png = bytes_of(kSignature + header(kWide, 8) + kRows + kEnd);
  PngDecoder decoder;
  const std::size_t before = allocated_bytes();
  const auto size = decoder.open(png);
  ASSERT_TRUE(size) << size.error().message;
  EXPECT_EQ(size->width, kWide);
  EXPECT_LT(allocated_bytes(), before + (1 << 20));
}

TEST(PngDecoder, FindsExifBeforeAndAfterThePixels) {
  const std::string exif("MM\0\x2a\0\0\0\x08\0\0", 10);
  const std::string chunk = png_chunk("eXIf", exif);
  EXPECT_EQ(decoded(bytes_of(kSignature + header(2, 2) + chunk + kRows + kEnd)).exif, exif);
  EXPECT_EQ(decoded(bytes_of(kSignature + header(2, 2) + kRows + chunk + kEnd)).exif, exif);
  EXPECT_EQ(decoded(bytes_of(kSignature + header(2, 2) + kRows + kEnd)).exif, "");
}

TEST(PngDecoder, RefusesATargetOfAnotherKind) {
  const auto png = some_picture();
  PngDecoder decoder;
  ASSERT_TRUE(decoder.open(png));
  std::vector<std::byte> bytes(7 * 11);
  EXPECT_FALSE(
      decoder.decode(MutablePicture::contiguous(PixelFormat::Grey, 7, 11, bytes.data(), 7)));
}

TEST(PngDecoder, KnowsItsSignature) {
  EXPECT_TRUE(is_png(some_picture()));
  EXPECT_FALSE(is_png(bytes_of(kSignature.substr(0, 7))));
  EXPECT_FALSE(is_png(bytes_of("GIF89a, and more")));
}

}  // namespace
}  // namespace orbwatch::hal
