// SPDX-License-Identifier: Apache-2.0
#include "hal/replay/replay_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <condition_variable>
#include <cstdlib>
#include <mutex>
#include <opencv2/imgcodecs.hpp>

#include "tests/hal/recording/picture_file.h"
#include "tests/hal/replay/exif_pictures.h"
#include "tests/hal/replay/picture_files.h"
#include "tests/hal/video/test_video.h"

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::HasSubstr;
using tests::TemporaryFolder;

constexpr auto kGuard = 60s;

/// Frames that a camera sent, for the test's thread.
class Listener {
 public:
  void start(Camera& camera) {
    const auto started = camera.start(
        [this](const Frame& frame) {
          note([&] {
            frames_.push_back(frame->metadata);
            values_.push_back(value_of(*frame));
          });
        },
        [this](const FaultReport& fault) { note([&] { faults_.push_back(fault); }); });
    ASSERT_TRUE(started) << started.error().message;
  }

  void wait_for_frames(std::size_t count) {
    wait([&] { return frames_.size() >= count; });
  }
  void wait_for_faults(std::size_t count) {
    wait([&] { return faults_.size() >= count; });
  }

  // To be read after Camera::stop().
  const std::vector<FrameMetadata>& frames() const { return frames_; }
  const std::vector<int>& values() const { return values_; }
  const std::vector<FaultReport>& faults() const { return faults_; }

 private:
  static int value_of(const FrameBuffer& frame) {
    return frame.picture.format == PixelFormat::Y16
               ? frame.picture.samples<std::uint16_t>().at(0, 0)[0]
               : frame.picture.samples<std::uint8_t>().at(0, 0)[0];
  }
  template <class Change>
  void note(Change change) {
    const std::lock_guard lock(mutex_);
    change();
    changed_.notify_all();
  }
  template <class Condition>
  void wait(Condition condition) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, kGuard, condition));
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<FrameMetadata> frames_;
  std::vector<int> values_;
  std::vector<FaultReport> faults_;
};

/// Value of every pixel of picture k of a test folder: needs all 16 bits.
int value_of(std::uint64_t picture) { return static_cast<int>(picture) * 9001 + 12345; }

void write_pictures(const TemporaryFolder& folder, int count) {
  for (int k = 0; k < count; ++k) {
    const cv::Mat image(6, 8, CV_16UC1, cv::Scalar(value_of(static_cast<std::uint64_t>(k))));
    ASSERT_TRUE(cv::imwrite((folder / ("f" + std::to_string(k) + ".png")).string(), image));
  }
}

ReplaySettings settings_for(const std::filesystem::path& source) {
  return {.name = "east", .source = source, .frame_rate = 200};
}

TEST(ReplayCamera, PlaysEachPictureAtItsSequenceNumber) {
  const TemporaryFolder folder;
  write_pictures(folder, 5);
  ReplayCamera camera(settings_for(folder.path()));
  const auto format = camera.configure({});
  ASSERT_TRUE(format) << format.error().message;
  EXPECT_EQ(format->format, PixelFormat::Y16);
  EXPECT_EQ(format->width, 8);
  EXPECT_EQ(format->height, 6);
  EXPECT_EQ(format->frame_rate, 200);
  Listener listener;
  listener.start(camera);
  listener.wait_for_frames(30);
  camera.stop();
  const auto& frames = listener.frames();
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(listener.values()[i], value_of(frames[i].sequence % 5)) << i;
    if (i == 0) continue;
    ASSERT_GT(frames[i].sequence, frames[i - 1].sequence);
    const auto numbers = static_cast<std::int64_t>(frames[i].sequence - frames[i - 1].sequence);
    const auto elapsed = frames[i].exposure_start - frames[i - 1].exposure_start;
    EXPECT_LE(std::chrono::abs(elapsed - numbers * 5ms), 1us) << "exposures must be nominal";
  }
  EXPECT_TRUE(listener.faults().empty());
}

/// Folder in which modules are looked for while this lives.
class Modules {
 public:
  explicit Modules(const std::filesystem::path& folder) {
    ::setenv("ORBWATCH_MODULES", folder.c_str(), 1);
  }
  ~Modules() { ::unsetenv("ORBWATCH_MODULES"); }
};

TEST(ReplayCamera, UsesTheRateAskedForElseTheSettingsElseTheVideosOwn) {
  const Modules modules(ORBWATCH_BUILT_MODULES);
  const TemporaryFolder folder;
  write_pictures(folder, 1);
  tests::write_video(folder / "recording.avi", 2);
  const auto rate = [](const std::filesystem::path& source, double set, double asked) {
    ReplayCamera camera({.name = "east", .source = source, .frame_rate = set});
    const auto format = camera.configure({.frame_rate = asked});
    return format ? format->frame_rate : -1.0;
  };
  EXPECT_EQ(rate(folder.path(), 0, 0), 30);
  EXPECT_EQ(rate(folder.path(), 12, 0), 12);
  EXPECT_EQ(rate(folder.path(), 12, 50), 50);
  EXPECT_NEAR(rate(folder / "recording.avi", 0, 0), tests::kVideoRate, 0.01);
  EXPECT_EQ(rate(folder / "recording.avi", 10, 0), 10);
  EXPECT_EQ(rate(folder.path(), -1, 0), -1) << "refused";
  EXPECT_EQ(rate(folder.path(), 1001, 0), -1) << "refused";
  EXPECT_EQ(rate(folder.path(), std::nan(""), 0), -1) << "refused";
}

TEST(ReplayCamera, EndsUnpluggedAfterPlayingOnce) {
  const TemporaryFolder folder;
  write_pictures(folder, 3);
  auto settings = settings_for(folder.path());
  settings.loop = false;
  ReplayCamera camera(settings);
  ASSERT_TRUE(camera.configure({}));
  for (int round = 0; round < 2; ++round) {
    Listener listener;
    listener.start(camera);
    listener.wait_for_faults(1);
    camera.stop();
    ASSERT_EQ(listener.faults().size(), 1U);
    EXPECT_EQ(listener.faults()[0].fault, Fault::Unplugged);
    EXPECT_EQ(listener.faults()[0].detail, "end of recording");
    ASSERT_FALSE(listener.frames().empty());
    EXPECT_EQ(listener.frames()[0].sequence, 0U) << "a restart begins with the first picture";
    EXPECT_LE(listener.frames().back().sequence, 2U);
  }
}

TEST(ReplayCamera, PlaysOnAfterADamagedPicture) {
  const TemporaryFolder folder;
  write_pictures(folder, 9);
  tests::truncate_file(folder / "f2.png", 0.8);
  ReplayCamera camera(settings_for(folder.path()));
  ASSERT_TRUE(camera.configure({}));
  Listener listener;
  listener.start(camera);
  listener.wait_for_frames(20);
  camera.stop();
  EXPECT_TRUE(listener.faults().empty());
  EXPECT_GE(camera.quality().damaged, 1U);
  for (const auto& frame : listener.frames()) EXPECT_NE(frame.sequence % 9, 2U);
}

TEST(ReplayCamera, PlaysAJpegPictureWithoutItsEndAndCountsIt) {
  const TemporaryFolder folder;
  const auto picture = folder / "f0.jpg";
  ASSERT_TRUE(cv::imwrite(picture.string(), cv::Mat(16, 16, CV_8UC1, cv::Scalar(128))));
  auto bytes = tests::file_bytes(picture);
  bytes.resize(bytes.size() - 2);
  tests::write_file(picture, bytes);
  ReplayCamera camera(settings_for(folder.path()));
  const auto format = camera.configure({});
  ASSERT_TRUE(format) << format.error().message;
  Listener listener;
  listener.start(camera);
  listener.wait_for_frames(3);
  camera.stop();
  EXPECT_TRUE(listener.faults().empty());
  EXPECT_EQ(camera.quality().flawed, listener.frames().size());
}

TEST(ReplayCamera, ManyDamagedPicturesAreAFault) {
  const TemporaryFolder folder;
  write_pictures(folder, 2);
  tests::truncate_file(folder / "f1.png", 0.8);
  ReplayCamera camera(settings_for(folder.path()));
  ASSERT_TRUE(camera.configure({}));
  Listener listener;
  listener.start(camera);
  listener.wait_for_faults(1);
  camera.stop();
  EXPECT_EQ(listener.faults()[0].fault, Fault::CorruptFrame);
  EXPECT_THAT(listener.faults()[0].detail, HasSubstr("f1.png"));
}

TEST(ReplayCamera, ShowsScriptedFaults) {
  const TemporaryFolder folder;
  write_pictures(folder, 3);
  auto settings = settings_for(folder.path());
  settings.faults = {
      {Fault::Unplugged, 20, 60}, {Fault::CorruptFrame, 100, 140}, {Fault::WrongFormat, 140, 180}};
  ReplayCamera camera(settings);
  ASSERT_TRUE(camera.configure({}));
  Listener listener;
  listener.start(camera);
  listener.wait_for_faults(5);
  camera.stop();
  std::vector<Fault> faults;
  for (const auto& report : listener.faults()) faults.push_back(report.fault);
  EXPECT_THAT(faults, ElementsAre(Fault::Unplugged, Fault::None, Fault::CorruptFrame,
                                  Fault::WrongFormat, Fault::None));
  for (std::size_t i = 0; i < listener.frames().size(); ++i) {
    const std::uint64_t n = listener.frames()[i].sequence;
    EXPECT_TRUE(n < 20 || (n >= 60 && n < 100) || n >= 180) << n;
    EXPECT_EQ(listener.values()[i], value_of(n % 3)) << "keeps its place in the recording";
  }
}

TEST(ReplayCamera, PlaysAVideo) {
  const Modules modules(ORBWATCH_BUILT_MODULES);
  const TemporaryFolder folder;
  tests::write_video(folder / "recording.avi", 8);
  ReplayCamera camera(settings_for(folder / "recording.avi"));
  const auto format = camera.configure({});
  ASSERT_TRUE(format) << format.error().message;
  EXPECT_EQ(format->format, PixelFormat::Rgb);
  Listener listener;
  listener.start(camera);
  listener.wait_for_frames(20);
  camera.stop();
  for (std::size_t i = 0; i < listener.frames().size(); ++i) {
    EXPECT_NEAR(listener.values()[i], tests::red_of(listener.frames()[i].sequence % 8), 6) << i;
  }
}

TEST(ReplayCamera, NeedsTheModuleForAVideoOnly) {
  const TemporaryFolder folder;
  const Modules none(folder.path());
  tests::write_video(folder / "recording.avi", 1);
  ReplayCamera video(settings_for(folder / "recording.avi"));
  const auto refused = video.configure({});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message,
              HasSubstr("camera east: the camera needs the module video, which is not installed: "
                        "sudo apt install ./orbwatch-camera-video_*.deb"));
  write_pictures(folder, 1);
  EXPECT_TRUE(ReplayCamera(settings_for(folder.path())).configure({}));
}

TEST(ReplayCamera, RefusesAFileThatIsNoVideo) {
  const Modules modules(ORBWATCH_BUILT_MODULES);
  const TemporaryFolder folder;
  tests::write_file(folder / "recording.avi", std::vector<std::byte>(4000, std::byte{'x'}));
  const auto refused = ReplayCamera(settings_for(folder / "recording.avi")).configure({});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("recording.avi: is not a video"));
}

TEST(ReplayCamera, LosesFramesWhenAllAreHeldAndComesBack) {
  const TemporaryFolder folder;
  write_pictures(folder, 3);
  ReplayCamera camera(settings_for(folder.path()));
  ASSERT_TRUE(camera.configure({}));
  std::mutex mutex;
  std::condition_variable changed;
  std::vector<Frame> held;
  bool holding = true;
  std::uint64_t last = 0;
  const auto on_frame = [&](const Frame& frame) {
    const std::lock_guard lock(mutex);
    if (holding) held.push_back(frame);
    last = frame->metadata.sequence;
    changed.notify_all();
  };
  const TimePoint begin = Clock::now();
  ASSERT_TRUE(camera.start(on_frame, [](const FaultReport&) {}));
  std::unique_lock lock(mutex);
  ASSERT_TRUE(changed.wait_for(lock, kGuard, [&] { return held.size() == kFreeRunningBuffers; }));
  // Some exposures must pass without a free buffer.
  EXPECT_FALSE(
      changed.wait_until(lock, begin + 200ms, [&] { return held.size() > kFreeRunningBuffers; }));
  const std::uint64_t last_held = last;
  EXPECT_EQ(held[0]->picture.samples<std::uint16_t>().at(0, 0)[0],
            value_of(held[0]->metadata.sequence % 3))
      << "held frames stay as they are";
  holding = false;
  held.clear();
  ASSERT_TRUE(changed.wait_for(lock, kGuard, [&] { return last > last_held + 1; }));
  lock.unlock();
  camera.stop();
}

constexpr std::uint64_t kRecordingBegin = 1'700'000'000'000'000'000;

/// Writes a recording of 8x6 pictures with the sequence 5, 6, 8, 9 of which each has its value;
/// those of "west" are exposed 2 ms later. The second frame set has trigger 70, the last 72.
void write_recording(const std::filesystem::path& path) {
  constexpr std::uint64_t kMillisecond = 1'000'000;
  tests::PictureFile file(path);
  const StreamFormat format{PixelFormat::Y16, {}, 8, 6, 25};
  tests::CameraTopics east(file, "east", format), west(file, "west", format);
  const auto states = file.add("/orbwatch/process_state", recording::SetNumbers::kType);
  for (const std::uint32_t k : {0U, 1U, 3U, 4U}) {
    const std::uint64_t time = kRecordingBegin + k * 10 * kMillisecond;
    std::vector<std::uint16_t> samples(48, static_cast<std::uint16_t>(value_of(k)));
    const auto picture =
        picture_of(PixelFormat::Y16, ImageView<std::uint16_t>{samples.data(), 8, 6, 1, 8});
    east.write(picture, {0, 0, 8, 6}, time, time, 5 + k);
    west.write(picture, {0, 0, 4, 6}, time, time + 2 * kMillisecond, 5 + k);
    const std::uint64_t trigger = k == 1 ? 70 : k == 4 ? 72 : 0;
    file.write(states, time, k, recording::SetNumbers{{}, k + 1, trigger});
  }
  file.finish();
}

TEST(ReplayCamera, PlaysARecordingAtItsMoments) {
  const TemporaryFolder folder;
  write_recording(folder / "event.mcap");
  ReplayCamera camera({.name = "east", .source = folder / "event.mcap"});
  const auto format = camera.configure({});
  ASSERT_TRUE(format) << format.error().message;
  EXPECT_EQ(format->format, PixelFormat::Y16);
  EXPECT_EQ(format->frame_rate, 25);
  Listener listener;
  listener.start(camera);
  listener.wait_for_frames(7);
  camera.stop();
  // The last picture is at 40 ms, and four frame sets come every 40 / 3 ms.
  const std::vector<Clock::duration> moments{0ms, 10ms, 30ms, 40ms};
  const Clock::duration length = 40ms + std::chrono::nanoseconds(13'333'333);
  const std::vector<std::uint64_t> numbers{0, 1, 3, 4};
  const std::vector<std::optional<std::uint64_t>> triggers{std::nullopt, 70, std::nullopt, 72};
  const auto& frames = listener.frames();
  for (std::size_t k = 0; k < frames.size(); ++k) {
    const std::size_t picture = k % 4, round = k / 4;
    EXPECT_EQ(listener.values()[k], value_of(numbers[picture]));
    EXPECT_EQ(frames[k].sequence, numbers[picture] + round * 5);
    EXPECT_EQ(frames[k].recorded_set, kRecordingBegin + numbers[picture] * 10'000'000);
    EXPECT_EQ(frames[k].exposure_start - frames[0].exposure_start,
              moments[picture] + static_cast<int>(round) * length);
    const auto trigger = triggers[picture];
    EXPECT_EQ(frames[k].trigger, trigger ? std::optional(*trigger + round * 3) : std::nullopt);
  }
}

TEST(ReplayCamera, PlaysARecordingOnce) {
  const TemporaryFolder folder;
  write_recording(folder / "event.mcap");
  ReplayCamera camera({.name = "west", .source = folder / "event.mcap", .loop = false});
  ASSERT_TRUE(camera.configure({}));
  Listener listener;
  listener.start(camera);
  listener.wait_for_faults(1);
  camera.stop();
  EXPECT_THAT(listener.values(), ElementsAre(value_of(0), value_of(1), value_of(3), value_of(4)));
  EXPECT_EQ(listener.faults().front().fault, Fault::Unplugged);
}

TEST(ReplayCamera, NeedsPicturesOfACameraOfItsName) {
  const TemporaryFolder folder;
  write_recording(folder / "event.mcap");
  const auto refused = ReplayCamera({.name = "up", .source = folder / "event.mcap"}).configure({});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("it has pictures of east, west"));
}

TEST(ReplayCamera, SaysWhyItCannotPlay) {
  const TemporaryFolder folder;
  const auto error = [](const std::filesystem::path& source, const StreamRequest& request) {
    const auto format = ReplayCamera(settings_for(source)).configure(request);
    return format ? std::string() : format.error().message;
  };
  EXPECT_THAT(error(folder / "missing", {}), HasSubstr("No such file"));
  EXPECT_THAT(error(folder.path(), {}), HasSubstr("*.jpg"));
  EXPECT_THAT(error("/dev/null", {}), HasSubstr("neither"));
  write_pictures(folder, 1);
  EXPECT_THAT(error(folder.path(), {.width = 9}), HasSubstr("8x6"));
  EXPECT_EQ(error(folder.path(), {.width = 8, .height = 6}), "");
}

TEST(ReplayCamera, NamesExifWhereItExchangesWidthAndHeight) {
  constexpr char kTurnClockwise = 6;
  const TemporaryFolder folder;
  tests::write_file(folder / "phone.jpg", tests::jpeg_with(tests::exif(kTurnClockwise)));
  ReplayCamera camera(settings_for(folder.path()));
  const auto refused = camera.configure({.width = 32, .height = 16});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message,
              HasSubstr("the recording has 16x32; its EXIF orientation turns its 32x16"));
  ASSERT_TRUE(camera.configure({}));
  EXPECT_EQ(camera.format_note(), "; its EXIF orientation turns its 32x16");
}

}  // namespace
}  // namespace orbwatch::hal
