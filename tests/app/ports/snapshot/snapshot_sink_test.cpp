// SPDX-License-Identifier: Apache-2.0
#include "app/ports/snapshot/snapshot_sink.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <ctime>
#include <fstream>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include "tests/app/hand_over.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app {
namespace {

using std::chrono::seconds;
namespace fs = std::filesystem;

constexpr int kWidth = 37, kHeight = 21;

enum class Measured { None, Luminance, Radiometric };

/// A view whose pixels all differ, also between frame sets.
ViewPtr view(std::size_t index, std::uint64_t frame_set, Measured measured = Measured::None,
             hal::TimePoint stamp = hal::Clock::now()) {
  static const char* const kNames[] = {"room", "process", "door"};
  auto made = std::make_shared<View>();
  made->index = index;
  made->name = kNames[index];
  made->frame_set = frame_set;
  made->stamp = stamp;
  const std::size_t pixels = std::size_t{kWidth} * kHeight;
  made->bytes.resize(pixels * 4);
  made->words.resize(pixels);
  for (std::size_t i = 0; i < made->bytes.size(); ++i) {
    made->bytes[i] = static_cast<std::uint8_t>(i * 7 + i / 256 + frame_set * 13);
  }
  for (std::size_t i = 0; i < pixels; ++i) {
    made->words[i] = static_cast<std::uint16_t>(20000 + i * 31 + frame_set);
  }
  made->picture = picture_of(PixelFormat::Rgb, ImageView<std::uint8_t>{made->bytes.data(), kWidth,
                                                                       kHeight, 3, 3 * kWidth});
  if (measured == Measured::Luminance) {
    made->luminance = {made->bytes.data() + 3 * pixels, kWidth, kHeight, 1, kWidth};
  }
  if (measured == Measured::Radiometric) {
    made->radiometric = {made->words.data(), kWidth, kHeight, 1, kWidth};
  }
  return made;
}

class SnapshotSinkTest : public testing::Test {
 protected:
  void start(int keep = 100) {
    sink.emplace(SnapshotSettings{folder.path() / "pictures", keep});
    const auto started = sink->start();
    ASSERT_TRUE(started) << started.error().message;
    set_live(true);
  }
  void set_live(bool live) {
    Status status;
    status.view_count = kMaxViews;
    for (ViewStatus& view : status.views) view.live = live;
    sink->accept(status);
  }
  CommandResult ask(std::size_t index) { return sink->request(index); }
  /// Requests a view, passes it and waits until it is on the disk.
  void take(const ViewPtr& picture) {
    const std::uint64_t before = sink->written();
    ASSERT_EQ(ask(picture->index), CommandResult::Done);
    tests::hand_over(*sink, picture);
    wait_for(before + 1);
  }
  void wait_for(std::uint64_t written) {
    const auto end = std::chrono::steady_clock::now() + seconds(30);
    while (sink->written() < written && std::chrono::steady_clock::now() < end) {
      std::this_thread::yield();
    }
    ASSERT_EQ(sink->written(), written);
  }
  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder.path() / "pictures")) {
      names.push_back(entry.path().filename().string());
    }
    std::ranges::sort(names);
    return names;
  }
  /// The only file whose name has this part, read by OpenCV.
  cv::Mat picture(const std::string& part) const {
    for (const std::string& name : files()) {
      if (name.find(part) == std::string::npos) continue;
      return cv::imread((folder.path() / "pictures" / name).string(), cv::IMREAD_UNCHANGED);
    }
    return {};
  }

  orbwatch::tests::TemporaryFolder folder;
  std::optional<SnapshotSink> sink;
};

cv::Mat as_matrix(const ImageView<std::uint8_t>& colour) {
  cv::Mat bgr(colour.height, colour.width, CV_8UC3);
  for (int y = 0; y < colour.height; ++y) {
    for (int x = 0; x < colour.width; ++x) {
      const std::uint8_t* rgb = colour.at(x, y);
      bgr.at<cv::Vec3b>(y, x) = {rgb[2], rgb[1], rgb[0]};
    }
  }
  return bgr;
}

bool are_equal(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && a.type() == b.type() && cv::norm(a, b, cv::NORM_INF) == 0;
}

TEST_F(SnapshotSinkTest, WritesTheNextPictureOfTheViewThatIsAskedFor) {
  start();
  tests::hand_over(*sink, view(0, 1));
  ASSERT_EQ(ask(0), CommandResult::Done);
  tests::hand_over(*sink, view(2, 2));
  const ViewPtr next = view(0, 2);
  tests::hand_over(*sink, next);
  tests::hand_over(*sink, view(0, 3));
  wait_for(1);
  ASSERT_EQ(files().size(), 1U) << "nobody asked for the others";
  EXPECT_TRUE(std::regex_match(files()[0], std::regex(R"(room_\d{8}T\d{6}\.\d{3}Z_2\.png)")))
      << files()[0];
  EXPECT_TRUE(are_equal(picture("room_"), as_matrix(next->picture.samples<std::uint8_t>())));
}

TEST_F(SnapshotSinkTest, TheRawMeasuredPlaneGoesBesideIt) {
  start();
  const ViewPtr thermal = view(1, 5, Measured::Radiometric), grey = view(1, 6, Measured::Luminance);
  take(thermal);
  take(grey);
  ASSERT_EQ(files().size(), 4U);
  EXPECT_TRUE(are_equal(picture("_5.png"), as_matrix(thermal->picture.samples<std::uint8_t>())));
  EXPECT_TRUE(are_equal(picture("_5_measured.png"),
                        cv::Mat(kHeight, kWidth, CV_16U, thermal->radiometric.data)));
  EXPECT_TRUE(
      are_equal(picture("_6_measured.png"), cv::Mat(kHeight, kWidth, CV_8U, grey->luminance.data)));
}

TEST_F(SnapshotSinkTest, NamesAreTheUtcOfTheExposure) {
  start();
  const auto stamp = hal::Clock::now() - seconds(3600);
  take(view(0, 1, Measured::None, stamp));
  const auto utc = std::chrono::floor<seconds>(hal::to_utc(stamp));
  const std::time_t time = std::chrono::system_clock::to_time_t(utc);
  std::tm parts{};
  gmtime_r(&time, &parts);
  std::array<char, 32> text{};
  std::strftime(text.data(), text.size(), "room_%Y%m%dT%H", &parts);
  EXPECT_EQ(files()[0].substr(0, 16), text.data());
}

TEST_F(SnapshotSinkTest, IsBusyWithAViewUntilItIsWritten) {
  start();
  ASSERT_EQ(ask(0), CommandResult::Done);
  EXPECT_EQ(ask(0), CommandResult::Busy);
  EXPECT_EQ(ask(1), CommandResult::Done) << "a view that does not come keeps no other waiting";
  tests::hand_over(*sink, view(1, 1));
  wait_for(1);
  EXPECT_EQ(ask(0), CommandResult::Busy);
  EXPECT_EQ(ask(1), CommandResult::Done);
  tests::hand_over(*sink, view(0, 2));
  tests::hand_over(*sink, view(1, 2));
  wait_for(3);
  EXPECT_EQ(ask(0), CommandResult::Done);
}

TEST_F(SnapshotSinkTest, KeepsAsManyViewsAsItSays) {
  start();
  EXPECT_EQ(sink->keeps().besides, 0U);
  std::vector<std::weak_ptr<const View>> views;
  for (std::uint64_t n = 1; sink->written() < 20; ++n) {
    const bool is_asked = ask(0) == CommandResult::Done;
    const ViewPtr next = view(0, n);
    if (is_asked) views.push_back(next);
    tests::hand_over(*sink, next);
    const auto kept = std::ranges::count_if(views, [](const auto& v) { return !v.expired(); });
    ASSERT_LE(static_cast<std::size_t>(kept), sink->keeps().of_each);
  }
}

TEST_F(SnapshotSinkTest, RefusesAViewOfWhichNoPictureCanCome) {
  start();
  ASSERT_EQ(ask(0), CommandResult::Done);
  set_live(false);
  EXPECT_EQ(ask(0), CommandResult::NotPossible) << "not busy for ever";
  tests::hand_over(*sink, view(0, 1));
  set_live(true);
  ASSERT_EQ(ask(0), CommandResult::Done);
  tests::hand_over(*sink, view(0, 2));
  wait_for(1);
  EXPECT_EQ(files().size(), 1U) << "what was asked for before is dropped";
  EXPECT_FALSE(picture("_2.png").empty());
}

TEST_F(SnapshotSinkTest, AnEarlierRunsHalfWrittenPicturesAreRemoved) {
  fs::create_directory(folder.path() / "pictures");
  std::ofstream(folder.path() / "pictures/room_20200101T000000.000Z_1.png.1-0.part") << "half";
  start();
  EXPECT_TRUE(files().empty());
}

TEST_F(SnapshotSinkTest, RefusesViewsThatCannotBe) {
  start();
  EXPECT_EQ(ask(kMaxViews), CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(ask(65535), CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(ask(kMaxViews - 1), CommandResult::Done);
}

TEST_F(SnapshotSinkTest, KeepsTheNewestAndLeavesOthersFilesAlone) {
  start(3);
  const fs::path pictures = folder.path() / "pictures";
  const std::vector<std::string> foreign{"notes.txt", "room.png", "room_20200101T000000.000Z_1.jpg",
                                         "room_20200101T000000Z_1.png",
                                         "room_20200101T000000.000Z_1_measured.png.bak"};
  for (const std::string& name : foreign) std::ofstream(pictures / name) << "mine";
  fs::create_directory(pictures / "folder");
  const auto now = hal::Clock::now();
  for (std::uint64_t n = 1; n <= 7; ++n) {
    take(view(1, n, Measured::Radiometric, now - seconds(100 - n)));
  }
  for (const std::string& name : foreign) EXPECT_TRUE(fs::exists(pictures / name)) << name;
  EXPECT_TRUE(fs::is_directory(pictures / "folder"));
  EXPECT_EQ(files().size(), foreign.size() + 1 + 3 * 2);
  for (const char* kept : {"_5.png", "_5_measured.png", "_6.png", "_7.png", "_7_measured.png"}) {
    EXPECT_FALSE(picture(kept).empty()) << kept;
  }
}

TEST_F(SnapshotSinkTest, EveryViewOfOneMomentCounts) {
  start(2);
  const auto stamp = hal::Clock::now() - seconds(10);
  for (const std::size_t index : {0U, 1U, 2U}) take(view(index, 9, Measured::None, stamp));
  EXPECT_EQ(files().size(), 2U);
  EXPECT_FALSE(picture("door_").empty()) << "what was written last stays";
}

TEST_F(SnapshotSinkTest, KeepsWhatItJustWroteWhenTheClockWasPutBack) {
  start(2);
  take(view(0, 1));
  take(view(0, 2));
  take(view(0, 3, Measured::None, hal::Clock::now() - std::chrono::hours(1)));
  EXPECT_EQ(files().size(), 2U);
  EXPECT_FALSE(picture("_3.png").empty());
  EXPECT_FALSE(picture("_2.png").empty());
}

/// A board without a battery-backed clock starts in 1970 until it reaches a time server; the other
/// files are then dated in the future.
TEST_F(SnapshotSinkTest, NewOnesAreNotTheOldestAfterTheClockWasPutBack) {
  const fs::path pictures = folder.path() / "pictures";
  fs::create_directory(pictures);
  const auto future = fs::file_time_type::clock::now() + std::chrono::hours(24 * 365 * 10);
  for (const char* name : {"room_20450101T000000.000Z_1.png", "room_20450101T000001.000Z_2.png",
                           "door_20450101T000002.000Z_3.png"}) {
    std::ofstream(pictures / name) << "a picture";
    fs::last_write_time(pictures / name, future);
  }
  start(3);
  take(view(0, 11));
  EXPECT_EQ(files().size(), 3U);
  take(view(0, 12, Measured::Radiometric));
  start(3);  // the order must survive a restart
  take(view(0, 13));
  EXPECT_EQ(files().size(), 4U);
  for (const char* kept : {"_11.png", "_12.png", "_12_measured.png", "_13.png"}) {
    EXPECT_FALSE(picture(kept).empty()) << kept;
  }
  take(view(0, 14));
  EXPECT_TRUE(picture("_11.png").empty());
  EXPECT_FALSE(picture("_14.png").empty());
}

TEST_F(SnapshotSinkTest, MakesItsFolderOrSaysWhyNot) {
  SnapshotSink deep({folder.path() / "a/b/c", 1});
  EXPECT_TRUE(deep.start());
  EXPECT_TRUE(fs::is_directory(folder.path() / "a/b/c"));
  deep.stop();
  std::ofstream(folder.path() / "file") << "no folder";
  for (const fs::path& bad : {folder.path() / "file", folder.path() / "file/below",
                              fs::path("/proc/orbwatch"), fs::path()}) {
    SnapshotSink refused({bad, 1});
    const auto started = refused.start();
    ASSERT_FALSE(started) << bad;
    EXPECT_NE(started.error().message.find("snapshot.folder: " + bad.string()), std::string::npos)
        << started.error().message;
    EXPECT_EQ(started.error().message.find('\n'), std::string::npos);
  }
}

TEST_F(SnapshotSinkTest, AFailureEndsNothing) {
  start();
  const fs::path pictures = folder.path() / "pictures";
  fs::remove(pictures);
  ASSERT_EQ(ask(0), CommandResult::Done);
  tests::hand_over(*sink, view(0, 1));
  const auto end = std::chrono::steady_clock::now() + seconds(30);
  CommandResult again = CommandResult::Busy;
  while (again == CommandResult::Busy && std::chrono::steady_clock::now() < end) {
    std::this_thread::yield();
    again = ask(0);
  }
  ASSERT_EQ(again, CommandResult::Done) << "it may be asked for again";
  EXPECT_EQ(sink->written(), 0U);
  fs::create_directory(pictures);
  tests::hand_over(*sink, view(0, 2));
  wait_for(1);
  EXPECT_EQ(files().size(), 1U);
}

TEST_F(SnapshotSinkTest, StopWritesWhatWasTaken) {
  for (std::uint64_t round = 1; round <= 10; ++round) {
    start();
    for (const std::size_t index : {0U, 1U, 2U}) {
      ASSERT_EQ(ask(index), CommandResult::Done);
      tests::hand_over(*sink, view(index, round));
    }
    sink->stop();
    EXPECT_EQ(sink->written(), 3U);
    EXPECT_EQ(files().size(), 3 * round);
    sink->stop();
  }
}

TEST_F(SnapshotSinkTest, StopsWithAViewThatNeverCame) {
  start();
  ASSERT_EQ(ask(0), CommandResult::Done);
  sink->stop();
  EXPECT_EQ(sink->written(), 0U);
  EXPECT_TRUE(files().empty());
}

TEST_F(SnapshotSinkTest, ManyAskWhileViewsCome) {
  start(1000);
  constexpr std::uint64_t kWanted = 60;
  std::atomic<std::uint64_t> granted{0};
  {
    const std::jthread views([&](const std::stop_token& stop) {
      for (std::uint64_t n = 1; !stop.stop_requested(); ++n) {
        for (const std::size_t index : {0U, 1U, 2U}) tests::hand_over(*sink, view(index, n));
      }
    });
    std::vector<std::jthread> asking;
    for (int thread = 0; thread < 2; ++thread) {
      asking.emplace_back([&] {
        const auto end = std::chrono::steady_clock::now() + seconds(30);
        for (std::size_t n = 0; granted < kWanted && std::chrono::steady_clock::now() < end; ++n) {
          granted += ask(n % 3) == CommandResult::Done ? 1U : 0U;
          std::this_thread::yield();
        }
      });
    }
    asking.clear();
    wait_for(granted);
  }
  sink->stop();
  EXPECT_EQ(sink->written(), granted) << "each request that was granted is one picture";
  EXPECT_EQ(files().size(), granted);
}

}  // namespace
}  // namespace orbwatch::app
