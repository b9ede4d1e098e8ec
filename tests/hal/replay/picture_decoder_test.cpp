#include "hal/replay/picture_decoder.h"

#include <gtest/gtest.h>

#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <string>

#include "tests/hal/replay/picture_files.h"

namespace orbwatch::hal {
namespace {

using tests::TemporaryFolder;

/// Each sample of each channel differs from its neighbours; channels are B G R as OpenCV has them.
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

std::vector<std::byte> jpeg_of(const cv::Mat& image) {
  std::vector<unsigned char> jpeg;
  EXPECT_TRUE(cv::imencode(".jpg", image, jpeg));
  const auto* first = reinterpret_cast<const std::byte*>(jpeg.data());
  return {first, first + jpeg.size()};
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

TEST(PictureDecoder, HonoursExifOrientation) {
  cv::Mat image(16, 32, CV_8UC1, cv::Scalar(0));
  image(cv::Rect(0, 0, 16, 16)).setTo(255);  // left half
  auto jpeg = jpeg_of(image);
  // TIFF header, one entry: 0x0112 Orientation, SHORT, count 1, value 6 (turn clockwise to see it).
  const std::string exif(
      "\xff\xe1\x00\x22"
      "Exif\0\0"
      "MM\0\x2a\0\0\0\x08"
      "\0\x01"
      "\x01\x12\0\x03\0\0\0\x01\0\x06\0\0"
      "\0\0\0\0",
      36);
  const auto* bytes = reinterpret_cast<const std::byte*>(exif.data());
  jpeg.insert(jpeg.begin() + 2, bytes, bytes + exif.size());
  const auto decoded = decode_picture(jpeg, "turned");
  ASSERT_TRUE(decoded) << decoded.error().message;
  EXPECT_EQ(decoded->picture.width, 16);
  EXPECT_EQ(decoded->picture.height, 32);
  const auto view = decoded->picture.samples<std::uint8_t>();
  EXPECT_GT(view.at(8, 4)[0], 250) << "the left half must be on top";
  EXPECT_LT(view.at(8, 28)[0], 5);
}

/// Decodes and returns the error; whatever the libraries print is a failure as well.
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
