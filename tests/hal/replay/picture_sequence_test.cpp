// SPDX-License-Identifier: Apache-2.0
#include "hal/replay/picture_sequence.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <vector>

#include "tests/hal/recording/picture_file.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::hal {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

constexpr std::uint64_t kSequenceBegin = 1'700'000'000'000'000'000;

/// Three pictures of 8x6, 100 ms apart: the region {2, 0, 4, 6}, with values 1000, 1001, 1002.
void write_sequence(const std::filesystem::path& path) {
  tests::PictureFile file(path);
  tests::CameraTopics east(file, "east", {PixelFormat::Y16, {}, 8, 6, 10});
  for (std::uint32_t n = 0; n < 3; ++n) {
    std::vector<std::uint16_t> samples(48, static_cast<std::uint16_t>(1000 + n));
    const auto picture =
        picture_of(PixelFormat::Y16, ImageView<std::uint16_t>{samples.data(), 8, 6, 1, 8});
    const std::uint64_t time = kSequenceBegin + n * 100'000'000;
    east.write(picture, {2, 0, 4, 6}, time, time + 5'000'000, n);
  }
  file.finish();
}

TEST(PictureSequence, HasTheCamerasPicturesOfARecording) {
  const tests::TemporaryFolder folder;
  write_sequence(folder / "event.mcap");
  auto sequence = PictureSequence::open(folder / "event.mcap", "east");
  ASSERT_TRUE(sequence) << sequence.error().message;
  ASSERT_EQ(sequence->size(), 3U);
  for (std::size_t n = 0; n < 3; ++n) {
    const auto read = sequence->read(n);
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->picture.format, PixelFormat::Y16);
    const auto samples = read->picture.samples<std::uint16_t>();
    ASSERT_EQ(samples.width, 8);
    EXPECT_EQ(samples.row(3)[1], 0);
    EXPECT_EQ(samples.row(3)[2], 1000 + n);
    EXPECT_EQ(samples.row(3)[5], 1000 + n);
    EXPECT_EQ(samples.row(3)[6], 0);
    EXPECT_EQ(sequence->time(n), milliseconds(100) * n);
    EXPECT_EQ(sequence->set_time(n), kSequenceBegin + n * 100'000'000);
  }
  EXPECT_EQ(sequence->name(1), "picture 1");
  EXPECT_THAT(sequence->path(1), HasSubstr("event.mcap: picture 1"));
}

TEST(PictureSequence, HasThePicturesOfAFolderWithoutTimes) {
  const tests::TemporaryFolder folder;
  for (const int n : {10, 9}) {
    cv::imwrite(folder / ("f" + std::to_string(n) + ".png"), cv::Mat(6, 8, CV_8U, cv::Scalar(n)));
  }
  auto sequence = PictureSequence::open(folder.path(), "east");
  ASSERT_TRUE(sequence) << sequence.error().message;
  ASSERT_EQ(sequence->size(), 2U);
  EXPECT_EQ(sequence->name(0), "f9.png");
  const auto read = sequence->read(1);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->picture.samples<std::uint8_t>().row(0)[0], 10);
  EXPECT_EQ(sequence->time(1), std::nullopt);
  EXPECT_EQ(sequence->set_time(1), std::nullopt);
}

TEST(PictureSequence, RefusesWhatHasNoPicturesOfTheCamera) {
  const tests::TemporaryFolder folder;
  write_sequence(folder / "event.mcap");
  const auto refusal = [&](const std::string& name, const char* camera) {
    const auto opened = PictureSequence::open(folder / name, camera);
    return opened ? std::string() : opened.error().message;
  };
  EXPECT_THAT(refusal("event.mcap", "up"), HasSubstr("it has pictures of east"));
  EXPECT_THAT(refusal("missing.mcap", "east"), HasSubstr("missing.mcap"));
  std::ofstream(folder / "text.mcap") << "no recording, whatever its name says";
  EXPECT_THAT(refusal("text.mcap", "east"), HasSubstr("text.mcap"));
}

}  // namespace
}  // namespace orbwatch::hal
