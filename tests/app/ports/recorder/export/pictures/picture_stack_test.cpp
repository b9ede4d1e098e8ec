// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/export/pictures/picture_stack.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "app/ports/recorder/recorded_utc.h"
#include "hal/recording/camera_recording.h"
#include "tests/app/ports/recorder/export/recorded_event.h"
#include "tests/hal/recording/picture_file.h"

/// TIFF of recorded pictures, read by OpenCV.
namespace orbwatch::app::recorder {
namespace {

using testing::HasSubstr;

std::vector<cv::Mat> pages_of(const std::filesystem::path& file) {
  std::vector<cv::Mat> pages;
  EXPECT_TRUE(cv::imreadmulti(file.string(), pages, cv::IMREAD_UNCHANGED));
  return pages;
}

class PictureStack : public tests::RecordedEventTest {
 protected:
  const std::filesystem::path stack_ = folder / "stack.tif";
};

TEST_F(PictureStack, HasTheSamplesOfEveryPicture) {
  const auto done =
      write_picture_stack(recording, "thermal", stamps(numbers(sets[2], sets[6])), stack_, go_on);
  ASSERT_TRUE(done) << done.error().message;
  const auto pages = pages_of(stack_);
  ASSERT_EQ(pages.size(), 5U);
  const auto& ball = tests::RecordedMachine::kBall;
  for (std::size_t k = 0; k < pages.size(); ++k) {
    SCOPED_TRACE(k);
    ASSERT_EQ(pages[k].type(), CV_16UC1);
    ASSERT_EQ(pages[k].size(), cv::Size(ball.width, ball.height));
    for (int y = 0; y < ball.height; ++y) {
      for (int x = 0; x < ball.width; ++x) {
        ASSERT_EQ(pages[k].at<std::uint16_t>(y, x),
                  tests::painted(sets[2 + k], 0, ball.x + x, ball.y + y));
      }
    }
  }
}

TEST_F(PictureStack, DescribesEveryPicture) {
  ASSERT_TRUE(
      write_picture_stack(recording, "thermal", stamps(numbers(sets[2], sets[3])), stack_, go_on));
  const auto pictures = hal::recording::CameraRecording::open(recording, "thermal");
  ASSERT_TRUE(pictures);
  const std::string text = tests::text_in(stack_);
  for (const std::size_t k : {2U, 3U}) {
    EXPECT_THAT(text,
                HasSubstr("{\"utc\":\"" + utc_text_at(pictures->index().exposures[k].start) +
                          "\",\"camera\":\"thermal\",\"frame_set\":" + std::to_string(sets[k]) +
                          ",\"x\":3,\"y\":2,\"width\":24,\"height\":16}"));
  }
}

TEST_F(PictureStack, NeedsACameraWhosePicturesTiffHasAsTheyAre) {
  const auto several = write_picture_stack(recording, "", {}, stack_, go_on);
  ASSERT_FALSE(several);
  EXPECT_THAT(several.error().message, HasSubstr("pictures of thermal, colour"));
  const auto unknown = write_picture_stack(recording, "../thermal", {}, stack_, go_on);
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, HasSubstr("there is no camera ../thermal"));
  const auto colour = write_picture_stack(recording, "colour", {}, stack_, go_on);
  ASSERT_FALSE(colour);
  EXPECT_THAT(colour.error().message, HasSubstr("grey and RGB"));
  EXPECT_FALSE(std::filesystem::exists(stack_));
}

TEST_F(PictureStack, IsCancelled) {
  const auto done = write_picture_stack(recording, "thermal", {}, stack_, cancel);
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message, HasSubstr("cancelled"));
}

TEST_F(PictureStack, DamageIsAnError) {
  damage();
  EXPECT_FALSE(write_picture_stack(recording, "thermal", {}, stack_, go_on));
}

/// A recording of one picture.
class OnePicture : public testing::Test {
 protected:
  const tests::TemporaryFolder folder_;
  const std::filesystem::path recording_ = folder_ / "a.mcap", stack_ = folder_ / "a.tif";

  Result<> stack() const {
    return write_picture_stack(recording_, "", {}, stack_, [](auto, auto, auto) { return true; });
  }
};

TEST_F(OnePicture, HasTheScaleOfItsCounts) {
  hal::StreamFormat format;
  format.format = PixelFormat::Y16;
  format.kelvin_per_count = 0.04;
  format.kelvin_offset = 100;
  const std::vector<std::uint16_t> counts(12, 5000);
  const ImageView<const std::uint16_t> view{counts.data(), 4, 3, 1, 4};
  Picture picture = Picture::contiguous(PixelFormat::Y16, view.width, view.height,
                                        reinterpret_cast<const std::byte*>(counts.data()), 8);
  tests::PictureFile file(recording_);
  tests::CameraTopics(file, "thermal", format).write(picture, {0, 0, 4, 3}, 1'000, 1'000, 1);
  file.finish();
  const auto done = stack();
  ASSERT_TRUE(done) << done.error().message;
  EXPECT_THAT(tests::text_in(stack_),
              HasSubstr("\"celsius_per_count\":0.04,\"celsius_at_zero\":-173.14999999999998}"));
  EXPECT_EQ(pages_of(stack_).at(0).at<std::uint16_t>(2, 3), 5000);
}

TEST_F(OnePicture, OfColourKeepsItsSamples) {
  std::vector<std::byte> samples;
  for (int k = 0; k < 5 * 3 * 3; ++k) samples.push_back(static_cast<std::byte>(3 * k));
  hal::StreamFormat format;
  format.format = PixelFormat::Rgb;
  tests::PictureFile file(recording_);
  tests::CameraTopics(file, "colour", format)
      .write(Picture::contiguous(PixelFormat::Rgb, 5, 3, samples.data(), 15), {0, 0, 5, 3}, 1'000,
             1'000, 1);
  file.finish();
  const auto done = stack();
  ASSERT_TRUE(done) << done.error().message;
  const auto pages = pages_of(stack_);
  ASSERT_EQ(pages.size(), 1U);
  ASSERT_EQ(pages[0].type(), CV_8UC3);
  for (int y = 0; y < 3; ++y) {
    for (int x = 0; x < 5; ++x) {
      const int first = 3 * (3 * (5 * y + x));
      EXPECT_EQ(pages[0].at<cv::Vec3b>(y, x),
                cv::Vec3b(static_cast<std::uint8_t>(first + 6),
                          static_cast<std::uint8_t>(first + 3), static_cast<std::uint8_t>(first)));
    }
  }
}

/// A header of JPEG that states 16000x16000 pixels of grey.
TEST_F(OnePicture, WhoseSizeLiesIsRefused) {
  std::vector<std::byte> jpeg;
  for (const int byte : {0xFF, 0xD8, 0xFF, 0xC0, 0, 11, 8, 0x3E, 0x80, 0x3E, 0x80, 1,    1,   0x11,
                         0,    0xFF, 0xDA, 0,    8, 1,  1, 0,    0,    63,   0,    0xFF, 0xD9}) {
    jpeg.push_back(static_cast<std::byte>(byte));
  }
  hal::recording::CompressedImage message;
  message.header = hal::recording::header_at(1'000, "grey");
  message.format = hal::recording::kGreyJpeg;
  message.data = jpeg;
  tests::PictureFile file(recording_);
  const auto channel = file.add(hal::recording::compressed_topic("orbwatch", "grey"),
                                hal::recording::CompressedImage::kType);
  file.write(channel, 1'000, 1, message);
  file.finish();
  const auto done = stack();
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message, HasSubstr("16000x16000; it must be at most 64 MiB large"));
}

}  // namespace
}  // namespace orbwatch::app::recorder
