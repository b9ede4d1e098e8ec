// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/pictures/camera_video.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "app/ports/recorder/export/pictures/avi_writer.h"
#include "app/ports/recorder/export/pictures/tiff_writer.h"
#include "hal/recording/messages.h"
#include "tests/app/ports/recorder/export/recorded_event.h"
#include "tests/hal/recording/picture_file.h"

/// AVI of recorded pictures, read by OpenCV.
namespace orbwatch::app::recorder {
namespace {

using testing::HasSubstr;

std::vector<cv::Mat> pictures_of(const std::filesystem::path& file) {
  cv::VideoCapture video(file.string());
  EXPECT_TRUE(video.isOpened());
  std::vector<cv::Mat> pictures;
  for (cv::Mat picture; video.read(picture);) pictures.push_back(picture.clone());
  return pictures;
}

class CameraVideo : public tests::RecordedEventTest {
 protected:
  Result<> write(const std::string& camera, const ExportRange& range, VideoText text) const {
    return write_camera_video(recording, camera, stamps(range), text, video_, go_on);
  }
  /// Frame sets with a new picture of the colour camera.
  std::vector<std::uint64_t> colour_sets(std::size_t first, std::size_t last) const {
    std::vector<std::uint64_t> found(sets.begin() + static_cast<long>(first),
                                     sets.begin() + static_cast<long>(last) + 1);
    std::erase_if(found, [](std::uint64_t set) { return set % 3 == 0; });
    return found;
  }

  const std::filesystem::path video_ = folder / "video.avi";
};

TEST_F(CameraVideo, HasTheRecordedJpegUnchanged) {
  const auto done = write("colour", numbers(sets[2], sets[9]), VideoText::None);
  ASSERT_TRUE(done) << done.error().message;
  const auto expected = colour_sets(2, 9);
  const std::string bytes = tests::text_in(video_);
  std::size_t at = 0;
  const auto recorded = tests::read_recording(recording)["/orbwatch/colour/image_raw/compressed"];
  for (const auto& message : recorded) {
    if (std::ranges::find(expected, message.sequence) == expected.end()) continue;
    hal::recording::CompressedImage image;
    ASSERT_TRUE(hal::mcap::decode_cdr(message.bytes, image));
    const std::string jpeg(reinterpret_cast<const char*>(image.data.data()), image.data.size());
    at = bytes.find(jpeg, at);
    ASSERT_NE(at, std::string::npos) << message.sequence;
    at += jpeg.size();
  }
  const auto pictures = pictures_of(video_);
  ASSERT_EQ(pictures.size(), expected.size());
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    EXPECT_EQ(pictures[k].size(), cv::Size(24, 16));
    // Grey of the frame's number in Y, and the same in U and V, which tints it.
    const auto level = static_cast<double>(60 + expected[k] % 100);
    EXPECT_NEAR(cv::mean(pictures[k])[1],
                level - 0.714136 * (level - 128) - 0.344136 * (level - 128), 4);
  }
}

TEST_F(CameraVideo, HasTheRateOfTheMedianInterval) {
  ASSERT_TRUE(write("thermal", {}, VideoText::None));
  cv::VideoCapture video(video_.string());
  EXPECT_NEAR(video.get(cv::CAP_PROP_FPS), 1e6 / 10'037, 0.01);
  EXPECT_EQ(video.get(cv::CAP_PROP_FRAME_COUNT), static_cast<double>(sets.size()));
}

TEST_F(CameraVideo, Of16BitIsStretchedFromTheDarkestToTheBrightestPixel) {
  ASSERT_TRUE(write("thermal", numbers(sets[2], sets[6]), VideoText::None));
  const auto pictures = pictures_of(video_);
  ASSERT_EQ(pictures.size(), 5U);
  const auto& ball = tests::RecordedMachine::kBall;
  const auto count = [&](std::size_t k, int x, int y) {
    return static_cast<double>(tests::painted(sets[2 + k], 0, ball.x + x, ball.y + y));
  };
  double low = 1e9, high = 0, error = 0;
  for (std::size_t k = 0; k < 5; ++k) {
    for (int n = 0; n < ball.width * ball.height; ++n) {
      low = std::min(low, count(k, n % ball.width, n / ball.width));
      high = std::max(high, count(k, n % ball.width, n / ball.width));
    }
  }
  for (std::size_t k = 0; k < 5; ++k) {
    ASSERT_EQ(pictures[k].size(), cv::Size(ball.width, ball.height));
    for (int n = 0; n < ball.width * ball.height; ++n) {
      const int x = n % ball.width, y = n / ball.width;
      error += std::abs(pictures[k].at<cv::Vec3b>(y, x)[0] -
                        (count(k, x, y) - low) * 255 / (high - low));
    }
  }
  EXPECT_LT(error / (5 * ball.width * ball.height), 6) << "mean, of noise as JPEG";
}

TEST_F(CameraVideo, WithTextKeepsThePictureAndTellsThemApart) {
  ASSERT_TRUE(write("colour", numbers(sets[2], sets[9]), VideoText::None));
  const auto plain = pictures_of(video_);
  std::filesystem::remove(video_);
  ASSERT_TRUE(write("colour", numbers(sets[2], sets[9]), VideoText::Values));
  const auto pictures = pictures_of(video_);
  ASSERT_EQ(pictures.size(), colour_sets(2, 9).size());
  ASSERT_EQ(pictures.size(), plain.size());
  for (std::size_t k = 0; k < pictures.size(); ++k) {
    EXPECT_EQ(pictures[k].cols, 400);
    const cv::Mat text = pictures[k].rowRange(16, pictures[k].rows);
    double most = 0;
    cv::minMaxLoc(text.reshape(1), nullptr, &most);
    EXPECT_GT(most, 150);
    EXPECT_LT(cv::mean(text)[0], 60);
    const cv::Rect middle(4, 4, 16, 8);
    EXPECT_LT(cv::norm(pictures[k](middle), plain[k](middle), cv::NORM_INF), 8);
    if (k == 0) continue;
    EXPECT_GT(cv::norm(text, pictures[k - 1].rowRange(16, pictures[k].rows), cv::NORM_INF), 100)
        << "another stamp";
  }
}

TEST_F(CameraVideo, IsCancelled) {
  for (const char* const camera : {"thermal", "colour"}) {
    const auto done = write_camera_video(recording, camera, {}, VideoText::None, video_, cancel);
    ASSERT_FALSE(done);
    EXPECT_THAT(done.error().message, HasSubstr("cancelled"));
    std::filesystem::remove(video_);
  }
}

TEST_F(CameraVideo, DamageIsAnError) {
  damage();
  EXPECT_FALSE(write_camera_video(recording, "thermal", {}, VideoText::Values, video_, go_on));
}

TEST(VideoOfSizes, ThatDifferIsRefused) {
  const tests::TemporaryFolder folder;
  const std::vector<std::byte> samples(8 * 8);
  const auto picture = Picture::contiguous(PixelFormat::Grey, 8, 8, samples.data(), 8);
  hal::StreamFormat format;
  tests::PictureFile file(folder / "a.mcap");
  tests::CameraTopics topics(file, "grey", format);
  topics.write(picture, {0, 0, 8, 8}, 1'000'000, 1'000'000, 1);
  topics.write(picture, {0, 0, 4, 8}, 2'000'000, 2'000'000, 2);
  file.finish();
  const auto done = write_camera_video(folder / "a.mcap", "", {}, VideoText::None, folder / "a.avi",
                                       [](auto, auto, auto) { return true; });
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message, HasSubstr("change their size from 8x8 to 4x8 at 1970-01-01"));
}

/// The size alone is refused, so none of these bytes is read.
TEST(LimitsOfFormats, AreErrors) {
  const tests::TemporaryFolder folder;
  const std::byte byte{};
  auto avi = AviWriter::create(folder / "a.avi", {8, 8, std::chrono::microseconds(1000)});
  ASSERT_TRUE(avi);
  const auto added = avi->add(std::span(&byte, std::size_t{1} << 31));
  ASSERT_FALSE(added);
  EXPECT_THAT(added.error().message, HasSubstr("at most 2 GiB; choose a smaller range"));
  auto tiff = TiffWriter::create(folder / "a.tif");
  ASSERT_TRUE(tiff);
  const auto page =
      tiff->add(Picture::contiguous(PixelFormat::Grey, 65'537, 65'535, &byte, 65'537), "{}");
  ASSERT_FALSE(page);
  EXPECT_THAT(page.error().message, HasSubstr("at most 4 GiB; choose a smaller range"));
}

}  // namespace
}  // namespace orbwatch::app::recorder
