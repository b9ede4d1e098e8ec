// SPDX-License-Identifier: Apache-2.0
#include "hal/replay/picture_decoder.h"

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tests/hal/png/written_png.h"
#include "tests/hal/replay/exif_pictures.h"
#include "tests/hal/replay/picture_files.h"

namespace orbwatch::hal {
namespace {

using tests::app1;
using tests::exif;
using tests::jpeg_of;
using tests::jpeg_with;
using tests::TemporaryFolder;

/// Pattern in which each sample of each channel differs from its neighbours; channels are B G R as
/// in OpenCV.
cv::Mat pattern(int type) {
  cv::Mat image(9, 13, type);
  const int samples = image.cols * image.channels();
  for (int y = 0; y < image.rows; ++y) {
    for (int i = 0; i < samples; ++i) {
      if (image.depth() == CV_16U) {
        image.ptr<std::uint16_t>(y)[i] = static_cast<std::uint16_t>(y * 7001 + i * 257 + 3);
      } else {
        image.ptr<std::uint8_t>(y)[i] = static_cast<std::uint8_t>(y * 17 + i * 5);
      }
    }
  }
  return image;
}

template <class T>
void expect_equal(const Picture& picture, const cv::Mat& truth) {
  ASSERT_EQ(picture.width, truth.cols);
  ASSERT_EQ(picture.height, truth.rows);
  const auto view = picture.samples<T>();
  const int channels = truth.channels();
  for (int y = 0; y < truth.rows; ++y) {
    for (int x = 0; x < truth.cols; ++x) {
      for (int c = 0; c < channels; ++c) {
        ASSERT_EQ(view.at(x, y)[c], truth.ptr<T>(y)[x * channels + channels - 1 - c])
            << x << "," << y << " channel " << c;
      }
    }
  }
}

Result<DecodedPicture> round_trip(const cv::Mat& image) {
  const TemporaryFolder folder;
  EXPECT_TRUE(cv::imwrite((folder / "picture.png").string(), image));
  return read_picture(folder / "picture.png");
}

TEST(PictureDecoder, KeepsDepthAndChannels) {
  const struct {
    int type;
    PixelFormat format;
  } cases[] = {{CV_8UC1, PixelFormat::Grey},
               {CV_16UC1, PixelFormat::Y16},
               {CV_8UC3, PixelFormat::Rgb},
               {CV_16UC3, PixelFormat::Rgb16}};
  for (const auto& [type, format] : cases) {
    const cv::Mat image = pattern(type);
    const auto decoded = round_trip(image);
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_EQ(decoded->picture.format, format);
    EXPECT_EQ(decoded->picture.planes[0].stride, row_bytes(format, 13));
    if (image.depth() == CV_16U) {
      expect_equal<std::uint16_t>(decoded->picture, image);
    } else {
      expect_equal<std::uint8_t>(decoded->picture, image);
    }
  }
}

TEST(PictureDecoder, DropsAlpha) {
  const auto decoded = round_trip(pattern(CV_8UC4));
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_EQ(decoded->picture.format, PixelFormat::Rgb);
}

TEST(PictureDecoder, ReadsGreyAndColourJpeg) {
  const auto grey = decode_picture(jpeg_of(cv::Mat(20, 30, CV_8UC1, cv::Scalar(77))), "grey");
  ASSERT_TRUE(grey) << grey.error().message;
  EXPECT_EQ(grey->picture.format, PixelFormat::Grey);
  EXPECT_EQ(grey->picture.samples<std::uint8_t>().at(29, 19)[0], 77);
  const auto red =
      decode_picture(jpeg_of(cv::Mat(20, 30, CV_8UC3, cv::Scalar(20, 40, 200))), "red");
  ASSERT_TRUE(red) << red.error().message;
  ASSERT_EQ(red->picture.format, PixelFormat::Rgb);
  const auto* pixel = red->picture.samples<std::uint8_t>().at(15, 10);
  EXPECT_NEAR(pixel[0], 200, 3);
  EXPECT_NEAR(pixel[2], 20, 3);
}

const std::string kXmp = app1(std::string("http://ns.adobe.com/xap/1.0/\0<x/>", 33));

/// Checks that the picture was turned clockwise, so that the left half is on top.
void expect_turned(const std::vector<std::byte>& jpeg, const std::string& what) {
  const auto decoded = decode_picture(jpeg, what);
  ASSERT_TRUE(decoded) << decoded.error().message;
  ASSERT_EQ(decoded->picture.width, 16) << what;
  ASSERT_EQ(decoded->picture.height, 32) << what;
  const auto view = decoded->picture.samples<std::uint8_t>();
  EXPECT_GT(view.at(8, 4)[0], 250) << what;
  EXPECT_LT(view.at(8, 28)[0], 5) << what;
  EXPECT_EQ(exif_note(*decoded), "; its EXIF orientation turns its 32x16");
}

TEST(PictureDecoder, HonoursExifOrientationInAnyApp1Segment) {
  constexpr char kTurnClockwise = 6;
  expect_turned(jpeg_with(exif(kTurnClockwise)), "EXIF alone");
  expect_turned(jpeg_with(exif(kTurnClockwise) + kXmp), "EXIF, XMP");
  expect_turned(jpeg_with(kXmp + exif(kTurnClockwise)), "XMP, EXIF");
  expect_turned(jpeg_with(app1(std::string(50000, 'x')) + kXmp + exif(kTurnClockwise)), "long XMP");
  expect_turned(jpeg_with(kXmp + exif(kTurnClockwise) + exif(1)), "the first EXIF counts");
  std::string little_endian = exif(0);
  little_endian.replace(10, 20,
                        std::string("II\x2a\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0\x06\0", 20));
  expect_turned(jpeg_with(kXmp + little_endian), "little endian");
}

TEST(PictureDecoder, ShowsEachExifOrientationUpright) {
  // Place of the stored picture's bright left half in the upright picture.
  const std::array<std::string_view, 10> expected{"left", "left", "right",  "right",  "left",
                                                  "top",  "top",  "bottom", "bottom", "left"};
  for (std::size_t n = 0; n < expected.size(); ++n) {
    const auto decoded = decode_picture(jpeg_with(exif(static_cast<char>(n))), "turned");
    ASSERT_TRUE(decoded) << decoded.error().message;
    const auto view = decoded->picture.samples<std::uint8_t>();
    const int right = decoded->picture.width - 1, bottom = decoded->picture.height - 1;
    const bool at_start = view.at(0, 0)[0] > 128;
    const bool along_row = (view.at(right, 0)[0] > 128) == at_start;
    const std::string_view bright =
        along_row ? (at_start ? "top" : "bottom") : (at_start ? "left" : "right");
    EXPECT_EQ(bright, expected[n]) << "orientation " << n;
    EXPECT_EQ(bottom > right, along_row) << "orientation " << n;
  }
}

TEST(PictureDecoder, TurnsAPngPictureByItsExif) {
  constexpr char kTurnClockwise = 6;
  constexpr std::size_t kBeforeTiff = 10;  // marker, length and name of a JPEG segment
  const std::string tiff = exif(kTurnClockwise).substr(kBeforeTiff);
  const tests::PngLayout layout{PNG_COLOR_TYPE_RGB, 8, 2, 1, false, tiff};
  const auto decoded = decode_picture(tests::written_png(layout, {{1, 2, 3, 4, 5, 6}}), "turned");
  ASSERT_TRUE(decoded) << decoded.error().message;
  ASSERT_EQ(decoded->picture.width, 1);
  ASSERT_EQ(decoded->picture.height, 2);
  EXPECT_EQ(std::memcmp(decoded->storage.get(), "\1\2\3\4\5\6", 6), 0);
  EXPECT_TRUE(decoded->is_turned);
}

TEST(PictureDecoder, LeavesAPictureWithDamagedExifAsItLies) {
  std::string beyond = exif(6);
  beyond[17] = '\x7f';  // part of the directory's offset
  for (const std::string& segments : {app1("Exif"), app1(std::string("Exif\0\0", 6)),
                                      app1(std::string("Exif\0\0MM", 8)), beyond, kXmp}) {
    const auto decoded = decode_picture(jpeg_with(segments), "as it lies");
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_EQ(decoded->picture.width, 32);
    EXPECT_EQ(exif_note(*decoded), "");
  }
}

TEST(PictureDecoder, TakesAJpegWithOtherDataInPlaceOfItsEnd) {
  for (const int progressive : {0, 1}) {
    std::vector<unsigned char> whole;
    ASSERT_TRUE(
        cv::imencode(".jpg", pattern(CV_8UC3), whole, {cv::IMWRITE_JPEG_PROGRESSIVE, progressive}));
    std::vector<unsigned char> followed(whole.begin(), whole.end() - 2);
    followed.insert(followed.end(), whole.begin(), whole.end());
    const auto bytes = [](const std::vector<unsigned char>& file) {
      return std::as_bytes(std::span(file));
    };
    const auto expected = decode_picture(bytes(whole), "whole");
    const auto decoded = decode_picture(bytes(followed), "followed");
    ASSERT_TRUE(decoded) << decoded.error().message;
    EXPECT_TRUE(decoded->is_flawed);
    EXPECT_FALSE(expected->is_flawed);
    EXPECT_EQ(std::memcmp(decoded->storage.get(), expected->storage.get(), 9 * 13 * 3), 0);
  }
}

/// Decodes and returns the error; any output of the libraries is a failure as well.
std::string silent_error(std::span<const std::byte> file) {
  testing::internal::CaptureStderr();
  const auto decoded = decode_picture(file, "damaged");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  return decoded ? "" : decoded.error().message;
}

TEST(PictureDecoder, RefusesTruncatedFilesWithOneErrorAndNothingOnStderr) {
  std::vector<unsigned char> png;
  ASSERT_TRUE(cv::imencode(".png", pattern(CV_16UC3), png));
  const auto* first = reinterpret_cast<const std::byte*>(png.data());
  const std::vector<std::byte> files[] = {{first, first + png.size()}, jpeg_of(pattern(CV_8UC3))};
  for (const auto& whole : files) {
    EXPECT_EQ(silent_error(whole), "");
    for (std::size_t length = 0; length < whole.size(); length += 7) {
      const std::string error = silent_error(std::span(whole.data(), length));
      EXPECT_TRUE(error.starts_with("damaged: ")) << length << " of " << whole.size();
      EXPECT_EQ(error.find('\n'), std::string::npos) << error;
    }
  }
}

TEST(PictureDecoder, RefusesOtherFilesAndSaysWhatItReads) {
  const TemporaryFolder folder;
  ASSERT_TRUE(cv::imwrite((folder / "picture.bmp").string(), pattern(CV_8UC3)));
  const auto bitmap = read_picture(folder / "picture.bmp");
  ASSERT_FALSE(bitmap);
  EXPECT_NE(bitmap.error().message.find("JPEG"), std::string::npos) << bitmap.error().message;
  EXPECT_NE(bitmap.error().message.find("PNG"), std::string::npos) << bitmap.error().message;
  EXPECT_NE(bitmap.error().message.find("picture.bmp"), std::string::npos);
  EXPECT_FALSE(read_picture(folder / "missing.png"));
  EXPECT_FALSE(read_picture(folder.path())) << "a folder";
  tests::write_file(folder / "empty.png", {});
  EXPECT_FALSE(read_picture(folder / "empty.png"));
}

TEST(PictureDecoder, RefusesHugePicturesBeforeDecoding) {
  for (const char* extension : {".png", ".jpg"}) {
    std::vector<unsigned char> file;
    ASSERT_TRUE(cv::imencode(extension, cv::Mat(1, 16385, CV_8UC1, cv::Scalar(9)), file));
    const auto* first = reinterpret_cast<const std::byte*>(file.data());
    const auto decoded = decode_picture({first, file.size()}, "wide");
    ASSERT_FALSE(decoded) << extension;
    EXPECT_NE(decoded.error().message.find("16384"), std::string::npos) << decoded.error().message;
    ASSERT_TRUE(cv::imencode(extension, cv::Mat(1, 16384, CV_8UC1, cv::Scalar(9)), file));
    first = reinterpret_cast<const std::byte*>(file.data());
    EXPECT_TRUE(decode_picture({first, file.size()}, "just right")) << extension;
  }
}

}  // namespace
}  // namespace orbwatch::hal
