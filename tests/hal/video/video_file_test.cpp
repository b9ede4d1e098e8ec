// SPDX-License-Identifier: Apache-2.0
#include "hal/video/video_file.h"

#include <gtest/gtest.h>

#include "hal/frame/frame_pool.h"
#include "tests/hal/replay/picture_files.h"
#include "tests/hal/video/test_video.h"

namespace orbwatch::hal {
namespace {

using tests::TemporaryFolder;

class VideoFileTest : public testing::Test {
 protected:
  void open(bool loop) {
    tests::write_video(folder_ / "recording.avi", 8);
    auto opened = VideoFile::open(folder_ / "recording.avi", loop);
    ASSERT_TRUE(opened) << opened.error().message;
    video_ = std::move(*opened);
  }

  void expect_picture(std::uint64_t number, std::uint64_t picture) {
    const auto buffer = pool_.acquire();
    const auto shown = video_->show(number, *buffer, {});
    ASSERT_TRUE(shown) << shown.error().detail;
    const auto* pixel = buffer->picture.samples<std::uint8_t>().at(30, 20);
    EXPECT_NEAR(pixel[0], tests::red_of(picture), 6) << "number " << number;
    EXPECT_NEAR(pixel[2], 200, 6) << "channels are R G B";
  }

  TemporaryFolder folder_;
  std::unique_ptr<Recording> video_;
  FramePool pool_ = make_frame_pool(PixelFormat::Rgb, tests::kVideoWidth, tests::kVideoHeight);
};

TEST_F(VideoFileTest, HasTheVideosFormatAndRate) {
  open(true);
  EXPECT_EQ(video_->format().format, PixelFormat::Rgb);
  EXPECT_EQ(video_->format().width, tests::kVideoWidth);
  EXPECT_EQ(video_->format().height, tests::kVideoHeight);
  EXPECT_NEAR(video_->format().frame_rate, tests::kVideoRate, 0.01);
}

TEST_F(VideoFileTest, ShowsNumberModuloCount) {
  open(true);
  for (std::uint64_t n = 0; n < 20; ++n) expect_picture(n, n % 8);
}

TEST_F(VideoFileTest, SkipsForwardAndBack) {
  open(true);
  expect_picture(5, 5);
  expect_picture(2, 2);
  expect_picture(2, 2);
  expect_picture(27, 3);
  expect_picture(801, 1);
}

TEST_F(VideoFileTest, EndsWhenItIsNotLooped) {
  open(false);
  expect_picture(7, 7);
  const auto buffer = pool_.acquire();
  const auto shown = video_->show(8, *buffer, {});
  ASSERT_FALSE(shown);
  EXPECT_EQ(shown.error().fault, Fault::Unplugged);
  EXPECT_EQ(shown.error().detail, "end of recording");
  expect_picture(0, 0);
}

TEST_F(VideoFileTest, RefusesWhatIsNoVideo) {
  tests::write_file(folder_ / "recording.avi", std::vector<std::byte>(4000, std::byte{'x'}));
  const auto opened = VideoFile::open(folder_ / "recording.avi", true);
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message.find("recording.avi"), std::string::npos);
}

}  // namespace
}  // namespace orbwatch::hal
