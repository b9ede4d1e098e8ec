// SPDX-License-Identifier: Apache-2.0
#include "app/cli/setup/recording.h"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include "hal/replay/replay_camera.h"
#include "tests/app/cli/recorded_pictures.h"
#include "tests/support/picture_of_mat.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::cli {
namespace {

using std::chrono::milliseconds;

class Recording : public testing::Test {
 protected:
  std::unique_ptr<hal::Camera> camera(const std::string& source) {
    hal::ReplaySettings settings;
    settings.name = source;
    settings.source = folder_ / source;
    settings.frame_rate = 200;
    settings.loop = false;
    return std::make_unique<hal::ReplayCamera>(settings);
  }

  void SetUp() override {
    std::filesystem::create_directory(folder_ / "three");
    for (int n = 0; n < 3; ++n) {
      const cv::Mat picture(48, 64, CV_8UC1, cv::Scalar(10 * (n + 1)));
      cv::imwrite(folder_ / "three" / (std::to_string(n) + ".png"), picture);
    }
    cv::imwrite(folder_ / "one.png", cv::Mat(48, 64, CV_16UC1, cv::Scalar(7000)));
  }

  tests::TemporaryFolder folder_;
};

TEST_F(Recording, KeepsWhatEveryCameraDelivers) {
  std::vector<std::unique_ptr<hal::Camera>> cameras;
  for (const char* source : {"three", "one.png", "missing"}) cameras.push_back(camera(source));
  const auto records = record(cameras, 24, std::chrono::seconds(30));
  ASSERT_EQ(records.size(), 3U);
  ASSERT_TRUE(records[0]) << records[0].error().message;
  // A picture may be skipped on a busy computer, but never replaced by another.
  ASSERT_FALSE(records[0]->pictures.empty());
  for (const RecordedPicture& recorded : records[0]->pictures) {
    const auto number = recorded.time / milliseconds(5);
    EXPECT_EQ(static_cast<int>(recorded.picture.planes[0].data[0]), 10 * (number + 1));
  }
  ASSERT_TRUE(records[1]) << records[1].error().message;
  ASSERT_EQ(records[1]->pictures.size(), 1U);
  EXPECT_EQ(records[1]->format.format, PixelFormat::Y16);
  EXPECT_EQ(records[1]->pictures[0].picture.samples<std::uint16_t>().data[0], 7000);
  ASSERT_FALSE(records[2]);
  EXPECT_NE(records[2].error().message.find("missing"), std::string::npos);
}

TEST_F(Recording, PicturesOfARecordingBelongTogetherByTheirMoment) {
  const cv::Mat grey(48, 64, CV_8U, cv::Scalar(70));
  std::vector<tests::RecordedPictureOf> pictures;
  for (const std::uint64_t set : {100U, 101U, 102U}) {
    pictures.push_back({"left", set, tests::picture_of_mat(grey)});
    if (set != 101) pictures.push_back({"right", set, tests::picture_of_mat(grey)});
  }
  tests::write_recorded_pictures(folder_ / "event.mcap", pictures);
  std::vector<std::unique_ptr<hal::Camera>> cameras;
  for (const char* name : {"left", "right"}) {
    cameras.push_back(std::make_unique<hal::ReplayCamera>(
        hal::ReplaySettings{.name = name, .source = folder_ / "event.mcap", .loop = false}));
  }
  const auto records = record(cameras, 24, std::chrono::seconds(30));
  ASSERT_TRUE(records[0]) << records[0].error().message;
  ASSERT_TRUE(records[1]) << records[1].error().message;
  ASSERT_EQ(records[0]->pictures.size(), 3U);
  ASSERT_EQ(records[1]->pictures.size(), 2U);
  const auto span = [](const CameraRecord& record) {
    return record.pictures.back().time - record.pictures.front().time;
  };
  EXPECT_EQ(span(*records[0]), span(*records[1]));
}

}  // namespace
}  // namespace orbwatch::app::cli
