// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <span>
#include <string>
#include <vector>

// Needs <cstdio> before it.
#include <jpeglib.h>

#include "hal/jpeg/jpeg_decoder.h"
#include "tests/hal/jpeg/jpeg_marker.h"

/// Faults of a picture among libjpeg's warnings.
namespace orbwatch::hal {
namespace {

constexpr int kCodedWidth = 72;
constexpr int kCodedHeight = 40;

using Bytes = std::vector<std::byte>;

/// Compression parameters of a picture.
struct Coding {
  std::string name;
  bool progressive = false;
  bool arithmetic = false;
  bool scan_for_each = false;  ///< components one after another, each in a scan of its own
  unsigned restart_rows = 0;   ///< rows of MCUs between restart markers
};

/// A sample of a non-repeating pattern, so that any loss shows.
std::uint8_t sample(int x, int y, int channel) {
  return static_cast<std::uint8_t>((x * x + 3 * y * y + 7 * x * y + 41 * channel) / 16);
}

void write_rows(jpeg_compress_struct& picture) {
  std::vector<std::uint8_t> row(3 * kCodedWidth);
  for (int y = 0; y < kCodedHeight; ++y) {
    for (int x = 0; x < kCodedWidth; ++x) {
      for (int c = 0; c < 3; ++c) row[static_cast<std::size_t>(3 * x + c)] = sample(x, y, c);
    }
    JSAMPROW first = row.data();
    jpeg_write_scanlines(&picture, &first, 1);
  }
}

Bytes compress(const Coding& coding) {
  jpeg_compress_struct picture{};
  jpeg_error_mgr errors{};
  picture.err = jpeg_std_error(&errors);
  jpeg_create_compress(&picture);
  unsigned char* file = nullptr;
  unsigned long size = 0;
  jpeg_mem_dest(&picture, &file, &size);
  picture.image_width = kCodedWidth;
  picture.image_height = kCodedHeight;
  picture.input_components = 3;
  picture.in_color_space = JCS_RGB;
  jpeg_set_defaults(&picture);
  jpeg_set_quality(&picture, 90, TRUE);
  picture.arith_code = coding.arithmetic ? TRUE : FALSE;
  picture.restart_in_rows = static_cast<int>(coding.restart_rows);
  if (coding.progressive) jpeg_simple_progression(&picture);
  const std::array<jpeg_scan_info, 3> scans{
      {{1, {0}, 0, 63, 0, 0}, {1, {1}, 0, 63, 0, 0}, {1, {2}, 0, 63, 0, 0}}};
  if (coding.scan_for_each) {
    picture.scan_info = scans.data();
    picture.num_scans = static_cast<int>(scans.size());
  }
  jpeg_start_compress(&picture, TRUE);
  write_rows(picture);
  jpeg_finish_compress(&picture);
  const auto* const first = reinterpret_cast<const std::byte*>(file);
  Bytes jpeg(first, first + size);
  jpeg_destroy_compress(&picture);
  std::free(file);
  return jpeg;
}

/// Result of decoding; an empty picture when it is refused.
struct Decoded {
  explicit Decoded(JpegDecoder& decoder, std::span<const std::byte> jpeg)
      : memory(kCodedWidth * kCodedHeight * 3 / 2) {
    const auto done = decoder.decode_nv12(
        jpeg, MutablePicture::contiguous(PixelFormat::Nv12, kCodedWidth, kCodedHeight,
                                         memory.data(), kCodedWidth));
    if (done) return;
    memory.clear();
    error = done.error().message;
  }
  bool is_refused() const { return memory.empty(); }

  Bytes memory;
  std::string error;
};

/// Offset of the last marker of a kind.
std::ptrdiff_t last_marker(const Bytes& jpeg, int marker) {
  for (std::size_t at = jpeg.size() - 2;; --at) {
    if (jpeg[at] == std::byte{0xff} && std::to_integer<int>(jpeg[at + 1]) == marker) {
      return static_cast<std::ptrdiff_t>(at);
    }
  }
}

constexpr int kStartOfScan = 0xda;

class JpegCoding : public testing::TestWithParam<Coding> {};

TEST_P(JpegCoding, IsWholeOrRefusedAtEveryLength) {
  const Bytes jpeg = compress(GetParam());
  ASSERT_GT(jpeg.size(), 1000U);
  JpegDecoder decoder;
  const Decoded whole(decoder, jpeg);
  ASSERT_FALSE(whole.is_refused()) << whole.error;
  EXPECT_FALSE(decoder.is_flawed());
  for (std::size_t length = 0; length < jpeg.size(); ++length) {
    const std::span part(jpeg.data(), length);
    const Decoded cut(decoder, part);
    EXPECT_EQ(decoder.check(part).has_value(), !cut.is_refused()) << length;
    if (cut.is_refused()) continue;
    ASSERT_EQ(cut.memory, whole.memory) << length << " of " << jpeg.size();
    ASSERT_TRUE(decoder.is_flawed()) << length << " of " << jpeg.size();
  }
}

TEST_P(JpegCoding, NeedsNoEndMarkerWhereTheRestTellsThatItIsWhole) {
  Bytes jpeg = compress(GetParam());
  jpeg.resize(jpeg.size() - kMarkerBytes);
  JpegDecoder decoder;
  EXPECT_EQ(Decoded(decoder, jpeg).is_refused(), GetParam().arithmetic);
}

TEST_P(JpegCoding, MayHavePaddingBeforeItsEnd) {
  const Bytes jpeg = compress(GetParam());
  JpegDecoder decoder;
  const Decoded whole(decoder, jpeg);
  Bytes padded = jpeg;
  // The first few of these bytes are in the decoder's bit buffer, unnoticed.
  padded.insert(padded.end() - kMarkerBytes, 16, std::byte{0});
  const Decoded decoded(decoder, padded);
  ASSERT_FALSE(decoded.is_refused()) << decoded.error;
  EXPECT_EQ(decoded.memory, whole.memory);
  EXPECT_TRUE(decoder.is_flawed());
  EXPECT_TRUE(decoder.check(padded));
  EXPECT_TRUE(decoder.is_flawed());
  ASSERT_TRUE(decoder.check(jpeg));
  EXPECT_FALSE(decoder.is_flawed()) << "of an earlier picture";
}

TEST_P(JpegCoding, MayHaveOtherDataInPlaceOfItsEnd) {
  const Bytes jpeg = compress(GetParam());
  JpegDecoder decoder;
  const Decoded whole(decoder, jpeg);
  const std::size_t picture = jpeg.size() - kMarkerBytes;
  const Bytes unknown_marker{std::byte{0xff}, std::byte{0x02}, std::byte{7}, std::byte{9}};
  const Bytes bad_length{std::byte{0xff}, std::byte{0xc4}, std::byte{0}, std::byte{1}};
  for (const Bytes& other : {jpeg, unknown_marker, bad_length}) {
    Bytes followed(jpeg.begin(), jpeg.end() - kMarkerBytes);
    followed.insert(followed.end(), other.begin(), other.end());
    const Decoded decoded(decoder, followed);
    // An arithmetic-coded scan does not reveal whether it is complete.
    ASSERT_EQ(decoded.is_refused(), GetParam().arithmetic) << decoded.error;
    EXPECT_EQ(decoder.check(followed).has_value(), !GetParam().arithmetic);
    if (GetParam().arithmetic) continue;
    EXPECT_EQ(decoded.memory, whole.memory);
    EXPECT_TRUE(decoder.is_flawed());
    EXPECT_EQ(decoder.picture_bytes(), picture);
    EXPECT_EQ(Decoded(decoder, jpeg).memory, whole.memory) << "the next picture";
    EXPECT_FALSE(decoder.is_flawed());
    EXPECT_EQ(decoder.picture_bytes(), jpeg.size());
  }
}

TEST_P(JpegCoding, IsRefusedWhereOtherDataFollowsBeforeItIsWhole) {
  const Bytes jpeg = compress(GetParam());
  JpegDecoder decoder;
  for (const std::size_t missing : {std::size_t{20}, jpeg.size() / 4}) {
    Bytes followed(jpeg.begin(), jpeg.end() - static_cast<std::ptrdiff_t>(missing));
    followed.insert(followed.end(), jpeg.begin(), jpeg.end());
    EXPECT_TRUE(Decoded(decoder, followed).is_refused()) << missing;
    EXPECT_FALSE(decoder.check(followed)) << missing;
  }
}

INSTANTIATE_TEST_SUITE_P(Codings, JpegCoding,
                         testing::Values(Coding{"sequential"},
                                         Coding{.name = "restarts", .restart_rows = 1},
                                         Coding{.name = "progressive", .progressive = true},
                                         Coding{.name = "scan_for_each", .scan_for_each = true},
                                         Coding{.name = "arithmetic", .arithmetic = true}),
                         [](const auto& run) { return run.param.name; });

TEST(JpegReader, TakesPaddingBeforeARestart) {
  const Bytes jpeg = compress({.name = "restarts", .restart_rows = 1});
  constexpr int kFirstRestart = 0xd0;
  Bytes padded = jpeg;
  padded.insert(padded.begin() + last_marker(jpeg, kFirstRestart), 2, std::byte{0});
  JpegDecoder decoder;
  const Decoded decoded(decoder, padded);
  ASSERT_FALSE(decoded.is_refused()) << decoded.error;
  EXPECT_TRUE(decoder.is_flawed());
  EXPECT_EQ(decoded.memory, Decoded(decoder, jpeg).memory);
}

TEST(JpegReader, RefusesAPictureWithoutOneOfItsComponents) {
  Bytes jpeg = compress({.name = "scan_for_each", .scan_for_each = true});
  jpeg.erase(jpeg.begin() + last_marker(jpeg, kStartOfScan), jpeg.end() - kMarkerBytes);
  JpegDecoder decoder;
  const Decoded decoded(decoder, jpeg);
  EXPECT_TRUE(decoded.is_refused());
  EXPECT_NE(decoded.error.find("ends early"), std::string::npos) << decoded.error;
}

TEST(JpegReader, RefusesMoreScansThanAPictureNeeds) {
  const Bytes jpeg = compress({.name = "scan_for_each", .scan_for_each = true});
  const auto scan = jpeg.begin() + last_marker(jpeg, kStartOfScan);
  const auto with_scans = [&](int more) {
    Bytes repeated = jpeg;
    for (int n = 0; n < more; ++n) {
      repeated.insert(repeated.end() - kMarkerBytes, scan, jpeg.end() - kMarkerBytes);
    }
    return repeated;
  };
  JpegDecoder decoder;
  EXPECT_FALSE(Decoded(decoder, with_scans(450)).is_refused());
  const Decoded hostile(decoder, with_scans(550));
  EXPECT_TRUE(hostile.is_refused());
  EXPECT_NE(hostile.error.find("has more than 500 scans"), std::string::npos) << hostile.error;
}

TEST(JpegReader, TakesTheNextPictureAfterAnyError) {
  const Bytes jpeg = compress({"sequential"});
  JpegDecoder decoder;
  const Decoded whole(decoder, jpeg);
  for (const std::size_t length :
       {std::size_t{0}, std::size_t{1}, std::size_t{30}, jpeg.size() / 2}) {
    ASSERT_TRUE(Decoded(decoder, {jpeg.data(), length}).is_refused());
    const Decoded next(decoder, jpeg);
    ASSERT_EQ(next.memory, whole.memory) << next.error;
    EXPECT_FALSE(decoder.is_flawed());
  }
}

}  // namespace
}  // namespace orbwatch::hal
