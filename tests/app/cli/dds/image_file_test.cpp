// SPDX-License-Identifier: Apache-2.0
#include "app/cli/dds/received_image.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <span>
#include <vector>

#include "tests/hal/replay/exif_pictures.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::cli {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Picture of two rows of two pixels, each row followed by a byte of padding that must not appear.
ReceivedImage two_by_two(const dds::ImageEncoding& encoding, const Bytes& bytes) {
  return {encoding, 2, 2, bytes.size() / 2, bytes.data(), false};
}

std::span<const std::uint8_t> bytes_of(const std::vector<std::byte>& file) {
  return {reinterpret_cast<const std::uint8_t*>(file.data()), file.size()};
}

class ImageFileTest : public testing::Test {
 protected:
  cv::Mat saved(const ReceivedImage& image) {
    const auto path = folder_.path() / "image.png";
    const auto result = save_png(image, path);
    EXPECT_TRUE(result) << result.error().message;
    EXPECT_EQ(folder_.files(), 1) << "the temporary file must be gone";
    return cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  }

  cv::Mat saved_jpeg(const std::vector<std::byte>& jpeg) {
    const auto path = folder_.path() / "image.png";
    const auto result = save_jpeg_as_png(bytes_of(jpeg), path);
    EXPECT_TRUE(result) << result.error().message;
    return cv::imread(path.string(), cv::IMREAD_UNCHANGED);
  }

  orbwatch::tests::TemporaryFolder folder_;
};

TEST_F(ImageFileTest, RedIsRedInEitherOrder) {
  const Bytes bytes{250, 20, 3, 4, 5, 6, 0xEE, 7, 8, 9, 10, 11, 12, 0xEE};
  const cv::Mat rgb = saved(two_by_two(dds::kRgb8, bytes));
  ASSERT_EQ(rgb.type(), CV_8UC3);
  EXPECT_EQ(rgb.at<cv::Vec3b>(0, 0), cv::Vec3b(3, 20, 250));
  EXPECT_EQ(rgb.at<cv::Vec3b>(1, 1), cv::Vec3b(12, 11, 10));
  const cv::Mat bgr = saved(two_by_two(dds::kBgr8, bytes));
  EXPECT_EQ(bgr.at<cv::Vec3b>(0, 0), cv::Vec3b(250, 20, 3));
}

TEST_F(ImageFileTest, GreyKeepsItsDepth) {
  const cv::Mat grey = saved(two_by_two(dds::kMono8, {1, 2, 0xEE, 3, 255, 0xEE}));
  ASSERT_EQ(grey.type(), CV_8UC1);
  EXPECT_EQ(grey.at<std::uint8_t>(1, 1), 255);

  std::vector<std::uint16_t> counts{0x1234, 1, 0xEEEE, 65535, 0x8001, 0xEEEE};
  ReceivedImage image{dds::kMono16, 2, 2, 6, reinterpret_cast<std::uint8_t*>(counts.data()), false};
  cv::Mat wide = saved(image);
  ASSERT_EQ(wide.type(), CV_16UC1);
  EXPECT_EQ(wide.at<std::uint16_t>(0, 0), 0x1234);
  EXPECT_EQ(wide.at<std::uint16_t>(1, 0), 65535);
  EXPECT_EQ(wide.at<std::uint16_t>(1, 1), 0x8001);

  image.swapped = true;
  wide = saved(image);
  EXPECT_EQ(wide.at<std::uint16_t>(0, 0), 0x3412);
  EXPECT_EQ(wide.at<std::uint16_t>(1, 1), 0x0180);
}

TEST_F(ImageFileTest, AJpegPictureIsSavedAsItIs) {
  const cv::Mat colour = saved_jpeg(tests::jpeg_of({16, 16, CV_8UC3, cv::Scalar(20, 90, 200)}));
  ASSERT_EQ(colour.type(), CV_8UC3);
  EXPECT_LE(cv::norm(colour.at<cv::Vec3b>(8, 8), cv::Vec3b(20, 90, 200), cv::NORM_INF), 3);
  // Orientation 6 turns by 90 degrees: the pixels of a view stay where its geometry has them.
  const cv::Mat grey = saved_jpeg(tests::jpeg_with(tests::exif(6)));
  ASSERT_EQ(grey.type(), CV_8UC1);
  ASSERT_EQ(grey.size(), cv::Size(32, 16));
  EXPECT_GT(grey.at<std::uint8_t>(8, 8), 250);
  EXPECT_LT(grey.at<std::uint8_t>(8, 24), 5);
}

TEST_F(ImageFileTest, OnlyAWholeJpegPictureIsSaved) {
  Bytes png;
  ASSERT_TRUE(cv::imencode(".png", cv::Mat(8, 8, CV_8UC3, cv::Scalar(1, 2, 3)), png));
  const auto path = folder_.path() / "image.png";
  const auto refused = save_jpeg_as_png(png, path);
  ASSERT_FALSE(refused);
  EXPECT_TRUE(refused.error().message.starts_with("image: not a JPEG picture"))
      << refused.error().message;
  auto half = tests::jpeg_of({16, 16, CV_8UC3, cv::Scalar(20, 90, 200)});
  half.resize(half.size() / 2);
  EXPECT_FALSE(save_jpeg_as_png(bytes_of(half), path));
  EXPECT_EQ(folder_.files(), 0);
}

TEST_F(ImageFileTest, MissingFolderIsReported) {
  const auto path = folder_.path() / "absent" / "image.png";
  const Bytes bytes{1, 2, 3, 4};
  const auto result = save_png(two_by_two(dds::kMono8, bytes), path);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find(path.string()), std::string::npos);
}

TEST_F(ImageFileTest, AFileThatCannotBeReplacedStays) {
  const auto path = folder_.path() / "image.png";
  std::filesystem::create_directories(path / "inside");
  const Bytes bytes{1, 2, 3, 4};
  EXPECT_FALSE(save_png(two_by_two(dds::kMono8, bytes), path));
  EXPECT_TRUE(std::filesystem::is_directory(path));
  EXPECT_EQ(folder_.files(), 1) << "the temporary file must be gone";
}

}  // namespace
}  // namespace orbwatch::app::cli
