// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/simulated_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <cstring>
#include <functional>
#include <limits>
#include <mutex>

namespace orbwatch::app::simulation {
namespace {

using hal::Fault;

/// Keeps the frames and faults of a camera and waits for them.
class Audience {
 public:
  struct Shot {
    hal::FrameMetadata metadata;
    std::vector<std::byte> picture;
  };

  /// `hold`: keeps the buffers, like a consumer that never releases them.
  explicit Audience(bool hold = false) : hold_(hold) {}

  Result<> start(hal::Camera& camera) {
    return camera.start([this](const hal::Frame& frame) { take(frame); },
                        [this](const hal::FaultReport& report) {
                          const std::lock_guard lock(mutex_);
                          faults_.push_back(report.fault);
                          changed_.notify_all();
                        });
  }

  /// True when `done` held before the guard time was over.
  bool wait(const std::function<bool(const Audience&)>& done) {
    std::unique_lock lock(mutex_);
    return changed_.wait_for(lock, std::chrono::seconds(120), [&] { return done(*this); });
  }
  bool wait_for_frames(std::size_t count) {
    return wait([count](const Audience& a) { return a.shots.size() >= count; });
  }
  bool wait_for_faults(std::size_t count) {
    return wait([count](const Audience& a) { return a.faults_.size() >= count; });
  }
  void let_go() {
    const std::lock_guard lock(mutex_);
    held_.clear();
    hold_ = false;
  }

  std::vector<Shot> shots;  ///< to be read after the camera was stopped, or inside wait()
  std::vector<Fault> faults() const { return faults_; }

 private:
  void take(const hal::Frame& frame) {
    const std::lock_guard lock(mutex_);
    const Picture& picture = frame->picture;
    shots.push_back({frame->metadata,
                     {picture.planes[0].data,
                      picture.planes[0].data + picture.planes[0].stride * picture.height}});
    if (hold_) held_.push_back(frame);
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  bool hold_;
  std::vector<hal::Frame> held_;
  std::vector<Fault> faults_;
};

std::shared_ptr<const Machine> machine_of_seed(std::uint64_t seed = 1) {
  MachineSettings settings;
  settings.seed = seed;
  return Machine::make(settings, hal::Clock::now()).value();
}

/// Small pictures, many of them.
SimulatedCameraSettings small(CameraKind kind = CameraKind::Colour) {
  SimulatedCameraSettings settings;
  settings.name = "small";
  settings.kind = kind;
  settings.width = 64;
  settings.height = 48;
  settings.frame_rate = 200;
  settings.noise_sigma = 0;
  return settings;
}

TEST(SimulatedCamera, CountsBeginAtTheOffset) {
  const auto machine = machine_of_seed();
  SimulatedCamera camera(machine, small(CameraKind::Thermal));
  ASSERT_TRUE(camera.configure({}));
  const auto words_of = [&](double offset) {
    const Renderer renderer(machine, camera.pinhole(), {CameraKind::Thermal, 0.1, offset});
    std::vector<std::uint16_t> words(renderer.size() / 2);
    renderer.render(0, reinterpret_cast<std::byte*>(words.data()));
    return words;
  };
  const auto from_0_kelvin = words_of(0), from_100_kelvin = words_of(100);
  for (std::size_t i = 0; i < from_0_kelvin.size(); ++i) {
    ASSERT_EQ(from_100_kelvin[i], from_0_kelvin[i] - 1000) << i;
  }
}

TEST(SimulatedCamera, SaysWhatItIsAndWhatItDelivers) {
  SimulatedCamera camera(machine_of_seed(), small(CameraKind::Thermal));
  EXPECT_EQ(camera.info().id, "small");
  EXPECT_EQ(camera.info().back_end, "simulated");
  const auto format = camera.configure({});
  ASSERT_TRUE(format);
  EXPECT_EQ(format->format, PixelFormat::Y16);
  EXPECT_EQ(format->width, 64);
  EXPECT_EQ(format->height, 48);
  EXPECT_EQ(format->frame_rate, 200);
  const auto wanted = camera.configure({.width = 80, .height = 60, .frame_rate = 25});
  ASSERT_TRUE(wanted);
  EXPECT_EQ(wanted->width, 80);
  EXPECT_EQ(wanted->height, 60);
  EXPECT_EQ(wanted->frame_rate, 25);
  EXPECT_EQ(camera.pinhole().cx(), 39.5);
}

TEST(SimulatedCamera, ExposesOnlyWhenItIsTriggeredInTriggerMode) {
  SimulatedCamera camera(machine_of_seed(), small());
  EXPECT_FALSE(camera.trigger()) << "TriggerMode is off";
  EXPECT_FALSE(camera.set("TriggerMode", 2));
  EXPECT_FALSE(camera.set("Gain", 1));
  ASSERT_TRUE(camera.set("TriggerMode", 1));
  ASSERT_TRUE(camera.configure({}));
  Audience audience;
  ASSERT_TRUE(audience.start(camera));
  for (std::size_t n = 1; n <= 5; ++n) {
    ASSERT_TRUE(camera.trigger());
    ASSERT_TRUE(audience.wait_for_frames(n));
  }
  camera.stop();
  ASSERT_EQ(audience.shots.size(), 5U);
  EXPECT_EQ(audience.shots.back().metadata.sequence, 4U);
}

TEST(SimulatedCamera, RefusesWhatItCannotBe) {
  using Spoil = std::function<void(SimulatedCameraSettings&, hal::StreamRequest&)>;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<std::pair<const char*, Spoil>> refusals{
      {"size", [](auto&, auto& request) { request.width = -1; }},
      {"size", [](auto&, auto& request) { request.height = 100000; }},
      {"frame rate", [](auto&, auto& request) { request.frame_rate = -5; }},
      {"frame rate", [](auto& settings, auto&) { settings.frame_rate = 0; }},
      {"field of view", [](auto& settings, auto&) { settings.horizontal_fov = 180; }},
      {"field of view", [&](auto& settings, auto&) { settings.horizontal_fov = nan; }},
      {"noise", [](auto& settings, auto&) { settings.noise_sigma = -1; }},
      {"kelvin", [](auto& settings, auto&) { settings.kelvin_per_count = 0; }},
      {"free space",
       [](auto& settings, auto&) {
         settings.position = {120, 60, 420};
       }},
      {"free space",
       [](auto& settings, auto&) {
         settings.position = {0, 0, 120};
       }},
      {"free space", [&](auto& settings, auto&) { settings.position.x = nan; }},
  };
  for (const auto& [word, spoil] : refusals) {
    SimulatedCameraSettings settings = small();
    hal::StreamRequest request;
    spoil(settings, request);
    SimulatedCamera camera(machine_of_seed(), settings);
    const auto format = camera.configure(request);
    ASSERT_FALSE(format) << word;
    EXPECT_NE(format.error().message.find(word), std::string::npos) << format.error().message;
    EXPECT_NE(format.error().message.find("small"), std::string::npos) << "names the camera";
  }
}

TEST(SimulatedCamera, ShowsTheProcessOfTheMomentInItsMetadata) {
  const auto shared = machine_of_seed();
  for (const CameraKind kind : {CameraKind::Colour, CameraKind::Thermal}) {
    SimulatedCamera camera(shared, small(kind));
    ASSERT_TRUE(camera.configure({}));
    Audience audience;
    ASSERT_TRUE(audience.start(camera));
    ASSERT_TRUE(audience.wait_for_frames(12));
    camera.stop();
    const Renderer renderer(shared, camera.pinhole(), {kind});
    std::vector<std::byte> expected(renderer.size());
    for (const auto& shot : audience.shots) {
      renderer.render(shared->process_time(shot.metadata.exposure_start), expected.data());
      ASSERT_EQ(shot.picture, expected);
    }
    EXPECT_NE(audience.shots.front().picture, audience.shots.back().picture);
  }
}

TEST(SimulatedCamera, CamerasOfDifferentRatesShareOneProcess) {
  const auto shared = machine_of_seed();
  SimulatedCameraSettings slow = small(CameraKind::Thermal);
  slow.frame_rate = 30;
  slow.position = {49, 395, 500};
  SimulatedCamera first(shared, small(CameraKind::Thermal));
  SimulatedCamera second(shared, slow);
  ASSERT_TRUE(first.configure({}));
  ASSERT_TRUE(second.configure({}));
  Audience of_first, of_second;
  ASSERT_TRUE(of_first.start(first));
  ASSERT_TRUE(of_second.start(second));
  ASSERT_TRUE(of_first.wait_for_frames(10));
  ASSERT_TRUE(of_second.wait_for_frames(10));
  first.stop();
  second.stop();
  for (const auto* const pair : {&of_first, &of_second}) {
    const SimulatedCamera& camera = pair == &of_first ? first : second;
    const Renderer renderer(shared, camera.pinhole(), {CameraKind::Thermal});
    std::vector<std::byte> expected(renderer.size());
    for (const auto& shot : pair->shots) {
      renderer.render(shared->process_time(shot.metadata.exposure_start), expected.data());
      ASSERT_EQ(shot.picture, expected);
    }
  }
}

TEST(SimulatedCamera, ExposesAtItsRateOnTheSteadyClock) {
  SimulatedCamera camera(machine_of_seed(), small());
  ASSERT_TRUE(camera.configure({.frame_rate = 250}));
  Audience audience;
  const hal::TimePoint before = hal::Clock::now();
  ASSERT_TRUE(audience.start(camera));
  ASSERT_TRUE(audience.wait_for_frames(20));
  camera.stop();
  const auto& first = audience.shots.front().metadata;
  const auto start = first.exposure_start - first.sequence * std::chrono::milliseconds(4);
  EXPECT_GE(start, before);
  for (const auto& [metadata, picture] : audience.shots) {
    EXPECT_EQ(metadata.exposure_start - start, metadata.sequence * std::chrono::milliseconds(4));
  }
}

TEST(SimulatedCamera, LosesExposuresWhileAllBuffersAreLent) {
  // The fault is the only signal that a camera without a free buffer continues its exposures.
  constexpr std::uint64_t kSignal = 60;
  SimulatedCameraSettings settings = small();
  settings.faults = {{Fault::ReadError, kSignal, kSignal + 1}};
  SimulatedCamera camera(machine_of_seed(), settings);
  ASSERT_TRUE(camera.configure({}));
  Audience audience(true);
  ASSERT_TRUE(audience.start(camera));
  ASSERT_TRUE(audience.wait_for_faults(1));
  audience.let_go();
  ASSERT_TRUE(audience.wait_for_frames(hal::kFreeRunningBuffers + 3));
  camera.stop();
  EXPECT_LT(audience.shots[hal::kFreeRunningBuffers - 1].metadata.sequence, kSignal);
  EXPECT_GT(audience.shots[hal::kFreeRunningBuffers].metadata.sequence, kSignal);
  EXPECT_THAT(audience.faults(), testing::ElementsAre(Fault::ReadError, Fault::None));
}

TEST(SimulatedCamera, PlaysItsFaultScriptAndRecovers) {
  SimulatedCameraSettings settings = small();
  settings.frame_rate = 100;
  settings.faults = {{Fault::Unplugged, 3, 6},
                     {Fault::Stalled, 9, 11},
                     {Fault::ReadError, 14, 15},
                     {Fault::CorruptFrame, 18, 23},
                     {Fault::WrongFormat, 26, 28}};
  SimulatedCamera camera(machine_of_seed(), settings);
  ASSERT_TRUE(camera.configure({}));
  Audience audience;
  ASSERT_TRUE(audience.start(camera));
  ASSERT_TRUE(audience.wait([](const Audience& a) {
    return !a.shots.empty() && a.shots.back().metadata.sequence >= 29;
  }));
  camera.stop();

  const hal::FaultScript script(settings.faults);
  for (const auto& shot : audience.shots) {
    EXPECT_EQ(script.at(shot.metadata.sequence), Fault::None) << shot.metadata.sequence;
  }
  // Each fault is reported once, and "delivers again" between them unless no frame came between.
  std::vector<Fault> faults = audience.faults();
  ASSERT_FALSE(faults.empty());
  EXPECT_EQ(faults.back(), Fault::None);
  std::erase(faults, Fault::None);
  EXPECT_THAT(faults, testing::ElementsAre(Fault::Unplugged, Fault::Stalled, Fault::ReadError,
                                           Fault::CorruptFrame, Fault::WrongFormat));
}

TEST(SimulatedCamera, CountsFromZeroAgainAfterARestart) {
  SimulatedCamera camera(machine_of_seed(), small());
  ASSERT_TRUE(camera.configure({}));
  for (int round = 0; round < 3; ++round) {
    Audience audience;
    ASSERT_TRUE(audience.start(camera));
    ASSERT_TRUE(audience.wait_for_frames(3));
    camera.stop();
    for (std::size_t i = 1; i < audience.shots.size(); ++i) {
      EXPECT_GT(audience.shots[i].metadata.sequence, audience.shots[i - 1].metadata.sequence);
    }
  }
  ASSERT_TRUE(camera.configure({.width = 32, .height = 32}));
  Audience audience;
  ASSERT_TRUE(audience.start(camera));
  ASSERT_TRUE(audience.wait_for_frames(1));
  camera.stop();
  EXPECT_EQ(audience.shots.front().picture.size(), 32U * 32 * 3);
}

/// Noise in each frame by its sequence: picture minus the picture without noise.
std::vector<std::pair<std::uint64_t, std::vector<int>>> noise_of(
    const std::shared_ptr<const Machine>& shared, const std::string& name) {
  SimulatedCameraSettings settings = small(CameraKind::Thermal);
  settings.name = name;
  settings.noise_sigma = 1.5;
  SimulatedCamera camera(shared, settings);
  EXPECT_TRUE(camera.configure({}));
  Audience audience;
  EXPECT_TRUE(audience.start(camera));
  EXPECT_TRUE(audience.wait([](const Audience& a) {
    return a.shots.size() >= 2 && a.shots.back().metadata.sequence >= 40;
  }));
  camera.stop();
  const Renderer renderer(shared, camera.pinhole(), {CameraKind::Thermal});
  std::vector<std::uint16_t> clean(renderer.size() / 2), noisy(clean.size());
  std::vector<std::pair<std::uint64_t, std::vector<int>>> result;
  for (const auto& shot : audience.shots) {
    renderer.render(shared->process_time(shot.metadata.exposure_start),
                    reinterpret_cast<std::byte*>(clean.data()));
    std::memcpy(noisy.data(), shot.picture.data(), shot.picture.size());
    std::vector<int> noise;
    for (std::size_t i = 0; i < clean.size(); ++i) noise.push_back(noisy[i] - clean[i]);
    result.emplace_back(shot.metadata.sequence, noise);
  }
  return result;
}

TEST(SimulatedCamera, NoiseFollowsFromSeedNameAndSequence) {
  const auto first = noise_of(machine_of_seed(1), "a");
  const auto again = noise_of(machine_of_seed(1), "a");
  const auto other_name = noise_of(machine_of_seed(1), "b");
  const auto other_seed = noise_of(machine_of_seed(2), "a");
  const auto equal_frames = [&](const auto& others) {
    int common = 0, equal = 0;
    for (const auto& [sequence, noise] : first) {
      for (const auto& [other_sequence, other_noise] : others) {
        if (other_sequence != sequence) continue;
        ++common;
        equal += other_noise == noise ? 1 : 0;
      }
    }
    EXPECT_GT(common, 0);
    return std::pair(equal, common);
  };
  const auto [equal, common] = equal_frames(again);
  EXPECT_EQ(equal, common);
  EXPECT_EQ(equal_frames(other_name).first, 0);
  EXPECT_EQ(equal_frames(other_seed).first, 0);
  EXPECT_NE(first[0].second, first[1].second);
}

}  // namespace
}  // namespace orbwatch::app::simulation
