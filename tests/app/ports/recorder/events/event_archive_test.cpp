// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_archive.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <utility>
#include <vector>

#include "app/ports/recorder/events/event_summary.h"
#include "hal/mcap/record.h"
#include "tests/app/ports/recorder/events/jpeg_frame.h"
#include "tests/hal/recording/picture_file.h"
#include "tests/support/picture_of_mat.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::recorder {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string kName = "20261128T092200.125Z-layer";

class Archive : public testing::Test {
 protected:
  fs::path make(const std::string& name) const {
    fs::path event = folder_ / "events" / name;
    fs::create_directories(event);
    std::ofstream(event / kEventFile) << "recording";
    EventSummary summary;
    summary.trigger = "layer";
    summary.text = "the layer changed";
    summary.alarm = {"pool", "hot_spot_width", signals::AlarmLevel::HighAlarm, 27.25, "mm"};
    summary.line = "button";
    summary.triggered = "2026-11-28T09:22:00.125Z";
    summary.part = "blade 7";
    summary.layer = 12;
    summary.pictures = {{"colour", 30}, {"thermal", 29}};
    summary.lost = 2;
    EXPECT_TRUE(write_summary(event, summary));
    return event;
  }

  const orbwatch::tests::TemporaryFolder folder_;
  EventArchive archive_{folder_.path()};
};

TEST_F(Archive, TellsWhatAnEventIs) {
  EXPECT_TRUE(archive_.list().value()->empty()) << "no folder yet";
  const fs::path event = make(kName);
  const auto events = archive_.list();
  ASSERT_TRUE(events) << events.error().message;
  ASSERT_EQ((*events)->size(), 1U);
  const RecordedEvent& one = (*events)->front();
  EXPECT_EQ(one.name, kName);
  EXPECT_EQ(one.trigger, "layer");
  ASSERT_TRUE(one.alarm);
  EXPECT_EQ(one.alarm->signal, "hot_spot_width");
  EXPECT_EQ(one.line, "button");
  EXPECT_EQ(one.part, "blade 7");
  EXPECT_EQ(one.layer, 12);
  EXPECT_EQ(one.pictures, 59U);
  EXPECT_EQ(one.lost, 2U);
  EXPECT_GT(one.bytes, 9U);
  EXPECT_TRUE(one.is_finished);
  EXPECT_EQ(archive_.recording(kName).value(), event / kEventFile);
  EXPECT_EQ(archive_.picture(kName).value(), event / kEventPicture);
}

/// Records a region of pictures of 16 bit: the nth has 100 n everywhere but 4000 at one pixel.
void record_pictures(const fs::path& path, int count) {
  const hal::recording::PictureRegion region{8, 4, 40, 30};
  const hal::StreamFormat format{PixelFormat::Y16, {}, 64, 48, 30, 0.04, 1};
  fs::remove(path);  // of make()
  orbwatch::tests::PictureFile file(path);
  orbwatch::tests::CameraTopics camera(file, "thermal", format);
  for (int n = 0; n < count; ++n) {
    cv::Mat1w samples(48, 64, static_cast<std::uint16_t>(100 * n));
    samples(20, 20) = 4000;
    const std::uint64_t time = 1'764'322'000'000'000'000 + std::uint64_t(n) * 40'000'000;
    camera.write(orbwatch::tests::picture_of_mat(samples), region, time, time, std::uint32_t(n));
  }
  file.finish();
}

TEST_F(Archive, ShowsThePartOfAPictureThatIsRecorded) {
  record_pictures(make(kName) / kEventFile, 3);
  const auto frames = archive_.frames(kName);
  ASSERT_TRUE(frames) << frames.error().message;
  ASSERT_EQ(frames->size(), 1U);
  EXPECT_EQ(frames->front().camera, "thermal");
  EXPECT_THAT(frames->front().times, testing::ElementsAre("2025-11-28T09:26:40.000000000Z",
                                                          "2025-11-28T09:26:40.040000000Z",
                                                          "2025-11-28T09:26:40.080000000Z"));
  ASSERT_EQ(frames->front().parts.size(), 1U);
  EXPECT_EQ(frames->front().parts.front().x, 8);
  EXPECT_EQ(frames->front().parts.front().height, 30);
  // In any order, and of another event between.
  record_pictures(make(kName + "-2") / kEventFile, 1);
  for (const auto& [name, n] : {std::pair(kName, 2), {kName + "-2", 0}, {kName, 1}}) {
    const auto jpeg = archive_.frame(name, "thermal", static_cast<std::size_t>(n));
    ASSERT_TRUE(jpeg) << jpeg.error().message;
    const cv::Mat shown =
        cv::imdecode(std::vector<char>(jpeg->begin(), jpeg->end()), cv::IMREAD_GRAYSCALE);
    EXPECT_EQ(shown.size(), cv::Size(40, 30));
    EXPECT_LT(shown.at<std::uint8_t>(0, 0), 8) << "the darkest";
    EXPECT_GT(shown.at<std::uint8_t>(16, 12), 200) << "the brightest";
  }
}

TEST_F(Archive, KeepsNoFileOfADeletedEvent) {
  record_pictures(make(kName) / kEventFile, 3);
  ASSERT_TRUE(archive_.frame(kName, "thermal", 1));
  const std::string events = fs::canonical(folder_ / "events").string();
  ASSERT_TRUE(archive_.remove(kName));
  for (const auto& open : fs::directory_iterator("/proc/self/fd")) {
    std::error_code closed;  // the iterator's own
    EXPECT_THAT(fs::read_symlink(open.path(), closed).string(), testing::Not(HasSubstr(events)));
  }
  EXPECT_FALSE(archive_.frame(kName, "thermal", 1));
}

TEST_F(Archive, NoticesThatARecordingHasChanged) {
  const fs::path file = make(kName) / kEventFile;
  record_pictures(file, 3);
  ASSERT_TRUE(archive_.frame(kName, "thermal", 2));
  record_pictures(file, 1);
  EXPECT_TRUE(archive_.frame(kName, "thermal", 0));
  EXPECT_THAT(archive_.frame(kName, "thermal", 2).error().message, HasSubstr("has changed"));
}

/// Changes a byte of the summary at the end of a recording.
void damage_summary(const fs::path& recording) {
  const auto place = static_cast<std::streamoff>(
      fs::file_size(recording) - hal::mcap::kMagic.size() - hal::mcap::kFooterSize - 1);
  std::fstream file(recording, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(place);
  const int byte = file.get();
  file.seekp(place);
  file.put(static_cast<char>(byte ^ 0x5A));
}

TEST_F(Archive, RefusesARecordingWithADamagedSummaryInsteadOfReadingAllOfIt) {
  const fs::path file = make(kName) / kEventFile;
  record_pictures(file, 3);
  ASSERT_TRUE(archive_.frame(kName, "thermal", 1));
  damage_summary(file);
  EventArchive other(folder_.path());  // without the index in memory
  const auto frames = other.frames(kName);
  ASSERT_FALSE(frames);
  EXPECT_THAT(frames.error().message, HasSubstr(file.string() + ": its summary is"));
  for (EventArchive* const archive : {&archive_, &other}) {
    const auto frame = archive->frame(kName, "thermal", 1);
    ASSERT_FALSE(frame);
    EXPECT_THAT(frame.error().message, HasSubstr(file.string() + ": its summary is"));
  }
}

/// Memory that the program has allocated, written or not.
std::size_t allocated_bytes() {
  const auto allocated = ::mallinfo2();
  return allocated.uordblks + allocated.hblkhd;
}

TEST_F(Archive, ShowsAPartOfTheLargestPictureWithoutMemoryForTheWhole) {
  const cv::Mat1w samples(30, 40, static_cast<std::uint16_t>(1000));
  Picture whole = orbwatch::tests::picture_of_mat(samples);  // pixels of its first corner alone
  whole.width = whole.height = kMaxSide;
  const fs::path path = make(kName) / kEventFile;
  fs::remove(path);
  orbwatch::tests::PictureFile file(path);
  orbwatch::tests::CameraTopics camera(file, "thermal",
                                       {PixelFormat::Y16, {}, 40, 30, 30, 0.04, 1});
  camera.write(whole, {0, 0, 40, 30}, 1'000'000'000, 1'000'000'000, 1);
  file.finish();
  const std::size_t before = allocated_bytes();
  const auto jpeg = archive_.frame(kName, "thermal", 0);
  ASSERT_TRUE(jpeg) << jpeg.error().message;
  EXPECT_LT(allocated_bytes(), before + (std::size_t{64} << 20)) << "512 MiB for the whole";
  const cv::Mat shown =
      cv::imdecode(std::vector<char>(jpeg->begin(), jpeg->end()), cv::IMREAD_GRAYSCALE);
  EXPECT_EQ(shown.size(), cv::Size(40, 30));
}

/// States the largest sides in the header of a JPEG picture.
void enlarge(std::vector<std::byte>& jpeg) {
  constexpr std::array kFrame{std::byte{0xFF}, std::byte{0xC0}};
  const auto frame = std::search(jpeg.begin(), jpeg.end(), kFrame.begin(), kFrame.end());
  ASSERT_GT(jpeg.end() - frame, 9);
  for (const int side : {5, 7}) {  // height and width
    frame[side] = std::byte{kMaxSide >> 8};
    frame[side + 1] = std::byte{kMaxSide & 0xFF};
  }
}

TEST_F(Archive, RefusesAPictureThatIsTooLargeToDecode) {
  const fs::path path = make(kName) / kEventFile;
  fs::remove(path);
  orbwatch::tests::PictureFile file(path);
  const auto channel = file.add(hal::recording::compressed_topic("orbwatch", "colour"),
                                hal::recording::CompressedImage::kType);
  auto sent = orbwatch::tests::sent_jpeg(1, 40, 30);
  enlarge(sent);
  hal::recording::CompressedImage message;
  message.header = hal::recording::header_at(1'000'000'000, "colour");
  message.format = hal::recording::kColourJpeg;
  message.data = sent;
  file.write(channel, 1'000'000'000, 1, message);
  file.finish();
  const auto refused = archive_.frame(kName, "colour", 0);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("16384x16384; it must be at most 64 MiB"));
}

TEST_F(Archive, RefusesPicturesThatItDoesNotHave) {
  record_pictures(make(kName) / kEventFile, 3);
  EXPECT_THAT(archive_.frame(kName, "thermal", 3).error().message,
              HasSubstr("no picture 3; 0 to 2 are recorded"));
  EXPECT_FALSE(archive_.frame(kName, "colour", 0));
  std::ofstream(make(kName) / kEventFile) << "no recording";
  EXPECT_FALSE(archive_.frames(kName));
}

TEST_F(Archive, PinsAndDeletes) {
  make(kName);
  ASSERT_TRUE(archive_.set_pinned(kName, true));
  EXPECT_TRUE(archive_.list().value()->front().is_pinned);
  ASSERT_TRUE(archive_.set_pinned(kName, false));
  EXPECT_FALSE(archive_.list().value()->front().is_pinned);
  ASSERT_TRUE(archive_.remove(kName));
  EXPECT_TRUE(archive_.list().value()->empty());
  EXPECT_THAT(archive_.remove(kName).error().message, HasSubstr("there is no event"));
}

TEST_F(Archive, LeavesAnEventThatIsBeingRecorded) {
  const fs::path event = make(kName + ".unfinished");
  EXPECT_FALSE(archive_.list().value()->front().is_finished);
  EXPECT_THAT(archive_.remove(kName).error().message, HasSubstr("is being recorded"));
  EXPECT_FALSE(archive_.set_pinned(kName, true));
  EXPECT_FALSE(archive_.recording(kName));
  EXPECT_TRUE(fs::exists(event / kEventFile));
}

TEST_F(Archive, RefusesNamesThatLeaveTheFolder) {
  make(kName);
  for (const std::string& name : {"../events/" + kName, std::string(".."), std::string()}) {
    EXPECT_THAT(archive_.recording(name).error().message, HasSubstr("is not the name of an event"));
    EXPECT_FALSE(archive_.remove(name));
  }
  EXPECT_EQ(archive_.list().value()->size(), 1U);
}

TEST_F(Archive, ListsAnEventWhoseSummaryIsDamaged) {
  std::ofstream(make(kName) / kEventSummary) << "{";
  const auto events = archive_.list();
  ASSERT_TRUE(events);
  EXPECT_EQ((*events)->front().name, kName);
  EXPECT_THAT((*events)->front().text, HasSubstr(kEventSummary));
  EXPECT_TRUE(archive_.remove(kName));
}

}  // namespace
}  // namespace orbwatch::app::recorder
