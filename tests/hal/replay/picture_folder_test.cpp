// SPDX-License-Identifier: Apache-2.0
#include "hal/replay/picture_folder.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "hal/frame/frame_pool.h"
#include "tests/hal/replay/picture_files.h"

namespace orbwatch::hal {
namespace {

using tests::TemporaryFolder;

TEST(NaturalOrder, CountsDigitsAsNumbers) {
  EXPECT_TRUE(natural_order("f2.png", "f10.png"));
  EXPECT_FALSE(natural_order("f10.png", "f2.png"));
  EXPECT_TRUE(natural_order("f002.png", "f10.png"));
  EXPECT_TRUE(natural_order("a9b2", "a9b11"));
  EXPECT_TRUE(natural_order("f", "f1"));
  EXPECT_TRUE(natural_order("f0", "f1"));
  EXPECT_TRUE(natural_order("f99999999999999999998", "f99999999999999999999")) << "beyond 64 bit";
  EXPECT_FALSE(natural_order("f1", "f1"));
  EXPECT_NE(natural_order("f1", "f01"), natural_order("f01", "f1")) << "must be a strict order";
}

/// Writes one grey picture whose pixels are all `value`.
void write(const std::filesystem::path& path, int value, int width = 4) {
  ASSERT_TRUE(cv::imwrite(path.string(), cv::Mat(3, width, CV_8UC1, cv::Scalar(value))));
}

class PictureFolderTest : public testing::Test {
 protected:
  void open(bool loop) {
    auto opened = PictureFolder::open(folder_.path(), loop);
    ASSERT_TRUE(opened) << opened.error().message;
    recording_ = std::move(*opened);
    const StreamFormat& format = recording_->format();
    pool_ = make_frame_pool(format.format, format.width, format.height);
  }

  /// Grey value of a picture, or minus the number of the fault.
  int show(std::uint64_t number) {
    const auto buffer = pool_->acquire();
    const auto shown = recording_->show(number, *buffer, {});
    return shown ? buffer->picture.samples<std::uint8_t>().at(3, 2)[0]
                 : -static_cast<int>(shown.error().fault);
  }

  TemporaryFolder folder_;
  std::unique_ptr<Recording> recording_;
  std::optional<FramePool> pool_;
};

TEST_F(PictureFolderTest, PlaysInNaturalOrderAndLeavesOtherFilesAlone) {
  write(folder_ / "f10.png", 30);
  write(folder_ / "f2.PNG", 20);
  write(folder_ / "f1.png", 10);
  write(folder_ / ".f0.png", 1);
  tests::write_file(folder_ / "notes.txt", {});
  open(true);
  EXPECT_EQ(recording_->format().frame_rate, 0);
  EXPECT_EQ(show(0), 10);
  EXPECT_EQ(show(1), 20);
  EXPECT_EQ(show(2), 30);
  EXPECT_EQ(show(3), 10);
  EXPECT_EQ(show(3'000'000'001), 20);
}

TEST_F(PictureFolderTest, EndsWhenItIsNotLooped) {
  write(folder_ / "f1.png", 10);
  write(folder_ / "f2.png", 20);
  open(false);
  EXPECT_EQ(show(1), 20);
  EXPECT_EQ(show(2), -static_cast<int>(Fault::Unplugged));
  EXPECT_EQ(show(0), 10);
}

TEST_F(PictureFolderTest, WithholdsWhatDoesNotFit) {
  write(folder_ / "f1.png", 10);
  write(folder_ / "f2.png", 20, 5);
  write(folder_ / "f3.png", 30);
  tests::truncate_file(folder_ / "f3.png", 0.7);
  ASSERT_TRUE(cv::imwrite((folder_ / "f4.png").string(), cv::Mat(3, 4, CV_16UC1, cv::Scalar(40))));
  write(folder_ / "f5.png", 50);
  open(true);
  EXPECT_EQ(show(0), 10);
  EXPECT_EQ(show(1), -static_cast<int>(Fault::WrongFormat));
  EXPECT_EQ(show(2), -static_cast<int>(Fault::CorruptFrame));
  EXPECT_EQ(show(3), -static_cast<int>(Fault::WrongFormat)) << "16 bit among 8 bit";
  EXPECT_EQ(show(4), 50);
}

TEST_F(PictureFolderTest, DecodesALargeFolderWhileItPlays) {
  // Two pictures of 33 MiB exceed the cache, so that a vanished file is noticed.
  const cv::Mat large(5889, 5889, CV_8UC1, cv::Scalar(10));
  ASSERT_TRUE(cv::imwrite((folder_ / "f1.png").string(), large));
  ASSERT_TRUE(cv::imwrite((folder_ / "f2.png").string(), large));
  open(true);
  EXPECT_EQ(show(1), 10);
  std::filesystem::remove(folder_ / "f2.png");
  EXPECT_EQ(show(1), -static_cast<int>(Fault::CorruptFrame));
  EXPECT_EQ(show(2), 10);
}

TEST_F(PictureFolderTest, KeepsASmallFolder) {
  write(folder_ / "f1.png", 10);
  open(true);
  std::filesystem::remove(folder_ / "f1.png");
  EXPECT_EQ(show(0), 10);
}

TEST_F(PictureFolderTest, SaysWhatItLookedFor) {
  tests::write_file(folder_ / "notes.txt", {});
  const auto opened = PictureFolder::open(folder_.path(), true);
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message.find("*.png"), std::string::npos) << opened.error().message;
}

TEST_F(PictureFolderTest, NeedsAFirstPictureThatCanBeDecoded) {
  write(folder_ / "f1.png", 10);
  tests::truncate_file(folder_ / "f1.png", 0.7);
  write(folder_ / "f2.png", 20);
  const auto opened = PictureFolder::open(folder_.path(), true);
  ASSERT_FALSE(opened);
  EXPECT_NE(opened.error().message.find("f1.png"), std::string::npos) << opened.error().message;
}

}  // namespace
}  // namespace orbwatch::hal
