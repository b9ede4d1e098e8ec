// SPDX-License-Identifier: Apache-2.0
#include "app/pictures/picture_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <random>
#include <vector>

#include "hal/replay/picture_decoder.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

constexpr int kPictureWidth = 37, kPictureHeight = 11;

/// Random samples whose rows are padded.
class PaddedPicture {
 public:
  explicit PaddedPicture(PixelFormat format) {
    constexpr int kPadding = 6;
    const int stride = row_bytes(format, kPictureWidth) + kPadding;
    bytes_.resize(static_cast<std::size_t>(stride) * kPictureHeight);
    std::minstd_rand random(3);
    for (std::byte& byte : bytes_) byte = static_cast<std::byte>(random() >> 8);
    picture = Picture::contiguous(format, kPictureWidth, kPictureHeight, bytes_.data(), stride);
  }

  Picture picture;

 private:
  std::vector<std::byte> bytes_;
};

class PictureFile : public testing::Test {
 protected:
  std::filesystem::path write(const Picture& picture, const std::string& name,
                              const ImageView<const std::uint8_t>& validity = {}) {
    const auto path = folder_ / name;
    const auto written = write_picture(path, picture, validity);
    EXPECT_TRUE(written) << written.error().message;
    return path;
  }

  orbwatch::tests::TemporaryFolder folder_;
};

TEST_F(PictureFile, APngHasEverySampleOfEachFormat) {
  for (const PixelFormat format :
       {PixelFormat::Grey, PixelFormat::Y16, PixelFormat::Rgb, PixelFormat::Rgb16}) {
    const PaddedPicture original(format);
    const auto read = hal::read_picture(write(original.picture, "written.png"));
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->picture.format, format);
    for (int y = 0; y < kPictureHeight; ++y) {
      const auto row = [y](const Picture& picture) {
        return picture.planes[0].data + y * picture.planes[0].stride;
      };
      EXPECT_EQ(std::memcmp(row(read->picture), row(original.picture),
                            static_cast<std::size_t>(row_bytes(format, kPictureWidth))),
                0)
          << info(format).name << " row " << y;
    }
  }
}

TEST_F(PictureFile, PixelsThatAreNotSeenAreTransparent) {
  std::vector<std::uint8_t> validity(kPictureWidth * kPictureHeight,
                                     static_cast<std::uint8_t>(Validity::Seen));
  validity[5] = static_cast<std::uint8_t>(Validity::Blind);
  validity[kPictureWidth] = static_cast<std::uint8_t>(Validity::Outside);
  const ImageView<const std::uint8_t> view{validity.data(), kPictureWidth, kPictureHeight, 1,
                                           kPictureWidth};
  for (const PixelFormat format :
       {PixelFormat::Grey, PixelFormat::Y16, PixelFormat::Rgb, PixelFormat::Rgb16}) {
    const PaddedPicture original(format);
    const cv::Mat read =
        cv::imread(write(original.picture, "written.png", view).string(), cv::IMREAD_UNCHANGED);
    ASSERT_EQ(read.channels(), 4) << info(format).name;
    const bool is_wide = info(format).bits == 16;
    for (int y = 0; y < kPictureHeight; ++y) {
      for (int x = 0; x < kPictureWidth; ++x) {
        const int alpha = is_wide ? read.at<cv::Vec4w>(y, x)[3] : read.at<cv::Vec4b>(y, x)[3];
        const bool is_seen = *view.at(x, y) == static_cast<std::uint8_t>(Validity::Seen);
        ASSERT_EQ(alpha, is_seen ? (is_wide ? 65535 : 255) : 0) << x << "," << y;
      }
    }
    const std::uint8_t first =
        is_wide ? std::to_integer<std::uint8_t>(original.picture.planes[0].data[1])
                : std::to_integer<std::uint8_t>(original.picture.planes[0].data[0]);
    const int red = is_wide ? read.at<cv::Vec4w>(0, 0)[2] >> 8 : read.at<cv::Vec4b>(0, 0)[2];
    EXPECT_EQ(red, first) << info(format).name;
  }
}

/// The measure is the encoder of OpenCV, which uses the accurate transform.
TEST_F(PictureFile, AJpegIsAsAccurateAsItsQualityAllows) {
  cv::Mat bgr(64, 96, CV_8UC3);
  for (int y = 0; y < bgr.rows; ++y) {
    for (int x = 0; x < bgr.cols; ++x) {
      bgr.at<cv::Vec3b>(y, x) = {static_cast<std::uint8_t>(2 * x), static_cast<std::uint8_t>(3 * y),
                                 static_cast<std::uint8_t>(x + y + 40 * (x / 8 % 2))};
    }
  }
  std::vector<std::uint8_t> expected;
  ASSERT_TRUE(cv::imencode(".jpg", bgr, expected, {cv::IMWRITE_JPEG_QUALITY, 95}));
  const auto path = write(Picture::contiguous(PixelFormat::Bgr, bgr.cols, bgr.rows,
                                              reinterpret_cast<const std::byte*>(bgr.data),
                                              static_cast<std::ptrdiff_t>(bgr.step)),
                          "written.jpg");
  const cv::Mat truth = cv::imdecode(expected, cv::IMREAD_COLOR);
  EXPECT_LE(cv::norm(cv::imread(path.string()), truth, cv::NORM_INF), 1);
}

TEST_F(PictureFile, SaysWhyItCannotBeWritten) {
  const PaddedPicture original(PixelFormat::Y16);
  const auto path = folder_ / "absent" / "written.png";
  const auto written = write_picture(path, original.picture);
  ASSERT_FALSE(written);
  EXPECT_NE(written.error().message.find(path.string()), std::string::npos);
  EXPECT_FALSE(write_picture(folder_ / "written.jpg", original.picture));
}

}  // namespace
}  // namespace orbwatch::app
