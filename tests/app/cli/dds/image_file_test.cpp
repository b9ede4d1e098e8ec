// SPDX-License-Identifier: Apache-2.0
#include "app/cli/dds/received_image.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "tests/support/temporary_folder.h"

namespace orbwatch::app::cli {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Picture of two rows of two pixels, each row followed by a byte of padding that must not appear.
ReceivedImage two_by_two(const dds::ImageEncoding& encoding, const Bytes& bytes) {
  return {encoding, 2, 2, bytes.size() / 2, bytes.data(), false};
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
