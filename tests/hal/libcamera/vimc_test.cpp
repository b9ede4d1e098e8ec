// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <filesystem>
#include <fstream>
#include <future>
#include <mutex>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "hal/frame/buffer_count.h"
#include "hal/libcamera/libcamera_camera.h"
#include "tests/hal/frame/udmabuf.h"

/// A frame's whole path through libcamera, with the kernel's virtual camera vimc. Run as root in a
/// machine of its own (tests/hil): a case takes the driver away. No case needs more than 8 frames,
/// since an emulated machine needs seconds for one.
namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kCamera = "Sensor B";
/// An emulated machine may be that slow; the rate determines when a camera has stalled.
constexpr StreamRequest kSmall{320, 240, 0.1};
/// Buffers of the vimc pipeline, for any request.
constexpr std::size_t kVimcBuffers = 4;
/// Limit after which a test fails; no wait normally takes so long.
constexpr auto kMaxWait = 120s;

/// Beginning of the notice about the number of buffers.
std::string fewer_buffers() {
  return std::to_string(kVimcBuffers) + " buffers instead of " +
         std::to_string(kFreeRunningBuffers);
}

/// Reports of a camera, for a test that waits for them.
class Witness {
 public:
  Camera::OnFrame on_frame() {
    return [this](Frame frame) {
      const std::lock_guard lock(mutex_);
      frames_.push_back(std::move(frame));
      told_.notify_all();
    };
  }
  Camera::OnFault on_fault() {
    return [this](const FaultReport& report) {
      const std::lock_guard lock(mutex_);
      faults_.push_back(report);
      told_.notify_all();
    };
  }

  /// Oldest frame that was not taken yet; null when none came.
  Frame frame() {
    std::unique_lock lock(mutex_);
    if (!told_.wait_for(lock, kMaxWait, [this] { return !frames_.empty(); })) return nullptr;
    Frame oldest = std::move(frames_.front());
    frames_.pop_front();
    return oldest;
  }

  bool is_told(Fault fault) {
    std::unique_lock lock(mutex_);
    return told_.wait_for(lock, kMaxWait, [this, fault] {
      return std::any_of(faults_.begin(), faults_.end(),
                         [fault](const FaultReport& report) { return report.fault == fault; });
    });
  }

  bool has_fault() {
    const std::lock_guard lock(mutex_);
    return std::ranges::any_of(faults_, [](const auto& r) { return r.fault != Fault::None; });
  }

  /// Drops frames that were not taken.
  void forget() {
    const std::lock_guard lock(mutex_);
    frames_.clear();
  }

 private:
  std::mutex mutex_;
  std::condition_variable told_;
  std::deque<Frame> frames_;
  std::vector<FaultReport> faults_;
};

std::size_t open_files() {
  const auto files = std::filesystem::directory_iterator("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

void write_to(const char* file, std::string_view text) {
  std::ofstream out(file);
  out << text << std::flush;
  ASSERT_TRUE(out) << file;
}

std::array<int, 3> colour_at(const Picture& picture, double x, double y) {
  const auto pixels = picture.samples<std::uint8_t>();
  const std::uint8_t* const pixel =
      pixels.at(static_cast<int>(x * picture.width), static_cast<int>(y * picture.height));
  return {pixel[0], pixel[1], pixel[2]};
}

double mean_of(const Picture& picture) {
  const auto pixels = picture.samples<std::uint8_t>();
  double sum = 0;
  for (int y = 0; y < picture.height; ++y) {
    sum = std::accumulate(pixels.row(y), pixels.row(y) + 3 * picture.width, sum);
  }
  return sum / (3.0 * picture.width * picture.height);
}

std::string configure_error(const LibcameraSettings& settings, const StreamRequest& request) {
  LibcameraCamera camera(settings);
  const auto format = camera.configure(request);
  return format ? std::string() : format.error().message;
}

TEST(Vimc, IsFoundByAPartOfItsName) {
  LibcameraCamera camera({.camera = kCamera});
  EXPECT_EQ(camera.info().model, kCamera);
  EXPECT_THAT(configure_error({.camera = "imx219"}, kSmall),
              AllOf(HasSubstr("imx219"), HasSubstr("\"platform/vimc.0 Sensor B\"")));
}

/// Test pattern of the driver: the eight bars of 75 % colours, white at the left.
TEST(Vimc, GivesItsTestPatternInOrderOfBytes) {
  LibcameraCamera camera({.camera = kCamera});
  const auto format = camera.configure(kSmall);
  ASSERT_TRUE(format) << format.error().message;
  EXPECT_EQ(format->format, PixelFormat::Rgb);
  EXPECT_EQ(format->width, 320);
  EXPECT_EQ(format->height, 240);
  EXPECT_EQ(format->frame_rate, 0) << "cannot be told one";
  Witness witness;
  const TimePoint start = Clock::now();
  ASSERT_TRUE(camera.start(witness.on_frame(), witness.on_fault()));
  const Frame frame = witness.frame();
  ASSERT_TRUE(frame);
  const Picture& picture = frame->picture;
  EXPECT_EQ(picture.format, PixelFormat::Rgb);
  EXPECT_EQ(picture.width, 320);
  EXPECT_EQ(picture.height, 240);
  EXPECT_GE(picture.planes[0].stride, 960);
  constexpr int kFull = 191;
  constexpr std::array<std::array<int, 3>, 8> kBars{{{kFull, kFull, kFull},
                                                     {kFull, kFull, 0},
                                                     {0, kFull, kFull},
                                                     {0, kFull, 0},
                                                     {kFull, 0, kFull},
                                                     {kFull, 0, 0},
                                                     {0, 0, kFull},
                                                     {0, 0, 0}}};
  for (std::size_t bar = 0; bar < kBars.size(); ++bar) {
    const double middle = (static_cast<double>(bar) + 0.5) / kBars.size();
    EXPECT_EQ(colour_at(picture, middle, 0.5), kBars[bar]) << "bar " << bar;
  }
  EXPECT_GE(frame->metadata.exposure_start, start);
  EXPECT_LE(frame->metadata.exposure_start, Clock::now());
  camera.stop();
}

TEST(Vimc, RefusesAnotherSizeInsteadOfTakingIt) {
  EXPECT_THAT(configure_error({.camera = kCamera}, {.width = 641, .height = 479}),
              AllOf(HasSubstr("641x479 would become"), HasSubstr("it offers BGR888")));
}

TEST(Vimc, RefusesASensorModeThatItCannotChoose) {
  EXPECT_THAT(configure_error({.camera = kCamera, .sensor_mode = {1920, 1080, 10}}, kSmall),
              HasSubstr("sensor mode"));
}

TEST(Vimc, RefusesAPixelFormatThatItHasNot) {
  EXPECT_THAT(configure_error({.camera = kCamera, .pixel_format = "NV12"}, kSmall),
              AllOf(HasSubstr("NV12"), HasSubstr("BGR888")));
}

TEST(Vimc, RestartsAndLeavesNoFileOpen) {
  LibcameraCamera camera({.camera = kCamera});
  std::set<std::size_t> files;
  for (int round = 0; round < 3; ++round) {
    Witness witness;
    ASSERT_TRUE(camera.configure(kSmall));
    ASSERT_TRUE(camera.start(witness.on_frame(), witness.on_fault()));
    const Frame first = witness.frame();
    const Frame second = witness.frame();
    ASSERT_TRUE(first && second) << "round " << round;
    EXPECT_EQ(first->metadata.sequence, 0U);
    EXPECT_GT(second->metadata.sequence, 0U);
    EXPECT_GT(second->metadata.exposure_start, first->metadata.exposure_start);
    camera.stop();
    camera.stop();
    files.insert(open_files());
  }
  EXPECT_EQ(files.size(), 1U) << "as many after each round: " << testing::PrintToString(files);
}

TEST(Vimc, StopsInsideTheCallback) {
  LibcameraCamera camera({.camera = kCamera});
  ASSERT_TRUE(camera.configure(kSmall));
  Witness witness;
  std::atomic<int> frames{0};
  const auto on_frame = witness.on_frame();
  ASSERT_TRUE(camera.start(
      [&](Frame frame) {
        ++frames;
        camera.stop();
        on_frame(std::move(frame));
      },
      witness.on_fault()));
  ASSERT_TRUE(witness.frame());
  camera.stop();
  EXPECT_EQ(frames, 1);
}

TEST(Vimc, WaitsForAConsumerThatHoldsAllBuffers) {
  LibcameraCamera camera({.camera = kCamera});
  ASSERT_TRUE(camera.configure(kSmall));
  Witness witness;
  ASSERT_TRUE(camera.start(witness.on_frame(), witness.on_fault()));
  std::vector<Frame> held;
  std::set<const std::byte*> memory;
  while (held.size() < kVimcBuffers) {
    held.push_back(witness.frame());
    ASSERT_TRUE(held.back());
    memory.insert(held.back()->picture.planes[0].data);
  }
  EXPECT_EQ(memory.size(), kVimcBuffers) << "each in a buffer of its own";
  const std::byte* const released = held.front()->picture.planes[0].data;
  held.erase(held.begin());
  const Frame next = witness.frame();
  ASSERT_TRUE(next);
  EXPECT_EQ(next->picture.planes[0].data, released) << "the only one that the driver has";
  camera.stop();
  EXPECT_GT(mean_of(held.back()->picture), 0) << "held frames stay valid";
}

TEST(Vimc, FillsMemoryThatItImports) {
  LibcameraCamera camera({.camera = kCamera}, [] { return std::vector{udmabuf()}; });
  std::promise<std::string> notice;
  camera.set_on_notice([&notice](const std::string& text) { notice.set_value(text); });
  ASSERT_TRUE(camera.configure(kSmall));
  Witness witness;
  ASSERT_TRUE(camera.start(witness.on_frame(), witness.on_fault()));
  EXPECT_EQ(notice.get_future().get(), fewer_buffers() + " from udmabuf");
  // More frames than buffers: each is queued again.
  for (int n = 0; n < 5; ++n) {
    const Frame frame = witness.frame();
    ASSERT_TRUE(frame);
    EXPECT_GT(mean_of(frame->picture), 0);
  }
  EXPECT_FALSE(witness.has_fault());
}

TEST(Vimc, StaysInItsDriversMemoryWithoutAnother) {
  LibcameraCamera camera({.camera = kCamera}, [] { return std::vector{empty_source()}; });
  std::promise<std::string> notice;
  camera.set_on_notice([&notice](const std::string& text) { notice.set_value(text); });
  ASSERT_TRUE(camera.configure(kSmall));
  Witness witness;
  ASSERT_TRUE(camera.start(witness.on_frame(), witness.on_fault()));
  EXPECT_EQ(notice.get_future().get(),
            fewer_buffers() +
                " in memory of the driver, which the CPU may not cache (empty: has no memory)");
  EXPECT_TRUE(witness.frame());
}

TEST(Vimc, SetsControls) {
  LibcameraCamera camera({.camera = kCamera});
  ASSERT_TRUE(camera.configure(kSmall));
  EXPECT_FALSE(camera.set("Brightness", 2)) << "-1 to 1";
  EXPECT_FALSE(camera.set("ExposureTime", 1000)) << "has none";
  ASSERT_TRUE(camera.set("Brightness", -0.5));
  Witness witness;
  ASSERT_TRUE(camera.start(witness.on_frame(), witness.on_fault()));
  const Frame dark = witness.frame();
  ASSERT_TRUE(dark);
  const double mean = mean_of(dark->picture);
  ASSERT_TRUE(camera.set("Brightness", 0.5));
  // Some frames were begun before the change.
  bool brighter = false;
  for (int i = 0; i < 7 && !brighter; ++i) {
    const Frame frame = witness.frame();
    ASSERT_TRUE(frame);
    brighter = mean_of(frame->picture) > mean + 40;
  }
  EXPECT_TRUE(brighter) << "not above " << mean;
  camera.stop();
}

/// libcamera ends the process when a camera that is not on USB reconnects, so the driver stays
/// away.
TEST(Vimc, IsLostWithItsDriverAndTheProgramLives) {
  LibcameraCamera camera({.camera = kCamera});
  ASSERT_TRUE(camera.configure({320, 240, 1}));
  Witness witness;
  ASSERT_TRUE(camera.start(witness.on_frame(), witness.on_fault()));
  const Frame before = witness.frame();
  ASSERT_TRUE(before);
  const double mean = mean_of(before->picture);
  ASSERT_NO_FATAL_FAILURE(write_to("/sys/bus/platform/drivers/vimc/unbind", "vimc.0"));
  EXPECT_TRUE(witness.is_told(Fault::Unplugged));
  EXPECT_EQ(mean_of(before->picture), mean) << "held frames stay valid";
  EXPECT_TRUE(camera.set("Brightness", 0)) << "recipes change without it";
  camera.stop();
  const auto again = camera.configure({320, 240, 1});
  ASSERT_FALSE(again);
  EXPECT_THAT(again.error().message, HasSubstr("restart"));
}

}  // namespace
}  // namespace orbwatch::hal
