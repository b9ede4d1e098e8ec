// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/genicam_camera.h"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>

#include "hal/genicam/device/features.h"
#include "hal/genicam/device/open_camera.h"
#include "hal/genicam/genicam_list.h"
#include "hal/sync/frame_sync.h"
#include "hal/test_pattern/test_pattern_settings.h"
#include "tests/hal/genicam/fake_gige_camera.h"
#include "tests/hal/genicam/resending_proxy.h"
#include "tests/support/share.h"

/// Tests on Aravis' fake camera, in a network of its own.
namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;
using testing::AllOf;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;
using tests::FakeGigeCamera;
using tests::Receiver;

class OnFakeCamera : public testing::Test {
 protected:
  void SetUp() override { ORBWATCH_REQUIRE_NETWORK_NAMESPACES(); }

  /// Executes `work` in a network with the fake camera.
  void run(const std::function<void(FakeGigeCamera&)>& work, double lost_per_thousand = 0) {
    run_with({.lost_per_thousand = lost_per_thousand}, work);
  }
  void run_with(const FakeGigeCamera::Options& options,
                const std::function<void(FakeGigeCamera&)>& work) {
    network_.emplace();
    network_->run([&] {
      FakeGigeCamera fake(options);
      work(fake);
    });
  }

  static GenicamSettings settings(const std::string& pixel_format = "Mono8") {
    GenicamSettings settings;
    settings.camera = FakeGigeCamera::kAddress;
    settings.pixel_format = pixel_format;
    return settings;
  }

  static StreamFormat configure(Camera& camera, const StreamRequest& request = {64, 48, 100}) {
    const auto format = camera.configure(request);
    EXPECT_TRUE(format) << format.error().message;
    return format.value_or(StreamFormat{});
  }

  static std::string refusal(const Result<>& done) { return done ? "" : done.error().message; }
  static std::string refusal(const GenicamSettings& settings, const StreamRequest& request) {
    const auto format = GenicamCamera(settings).configure(request);
    return format ? "" : format.error().message;
  }

  std::optional<tests::NetworkNamespace> network_;
};

/// Number that the fake camera gave to a frame; nullopt when a sample differs from the sent one.
std::optional<std::uint64_t> id_of(const Picture& picture) {
  const auto samples = picture.samples<std::uint16_t>();
  std::uint64_t id = 1;
  while (id < 65535 && tests::fake_sample_16(id, 0, 0) != samples.row(0)[0]) ++id;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (samples.row(y)[x] != tests::fake_sample_16(id, x, y)) return std::nullopt;
    }
  }
  return id;
}

struct Numbered {
  std::uint64_t sequence;
  std::optional<std::uint64_t> id;

  /// True if as many frames were sent since `first` as the sequence states. The ids wrap after
  /// 65535 to 1, which the fake camera's reach soon.
  bool follows(const Numbered& first) const {
    return (*first.id + sequence - first.sequence) % 65535 == *id % 65535;
  }
};
Numbered numbered(const FrameBuffer& frame) {
  return {frame.metadata.sequence, id_of(frame.picture)};
}

TEST_F(OnFakeCamera, EverySampleOf16BitIsAsItWasSent) {
  run([](FakeGigeCamera&) {
    GenicamCamera camera(settings("Mono16"));
    const StreamFormat format = configure(camera, {320, 240, 100});
    EXPECT_EQ(format.format, PixelFormat::Y16);
    Receiver<Numbered> receiver(numbered);
    receiver.start(camera);
    const auto frames = receiver.wait_for(50);
    camera.stop();
    ASSERT_TRUE(frames.front().id);
    for (const Numbered& frame : frames) {
      ASSERT_TRUE(frame.id) << "frame " << frame.sequence;
      EXPECT_TRUE(frame.follows(frames.front())) << "frame " << frame.sequence;
    }
  });
}

TEST_F(OnFakeCamera, EveryFormatThatItHasBecomesAPicture) {
  struct Case {
    const char* name;
    bool colour;
    PixelFormat format;
  };
  run([](FakeGigeCamera&) {
    for (const Case& c : {Case{"Mono8", true, PixelFormat::Grey},
                          {"RGB8", true, PixelFormat::Rgb},
                          {"BayerRG8", true, PixelFormat::Bgr},
                          {"BayerGB8", false, PixelFormat::Grey},
                          {"auto", true, PixelFormat::Rgb}}) {
      GenicamSettings wanted = settings(c.name);
      wanted.colour = c.colour;
      GenicamCamera camera(wanted);
      EXPECT_EQ(configure(camera).format, c.format) << c.name;
      Receiver<PixelFormat> receiver([](const FrameBuffer& frame) { return frame.picture.format; });
      receiver.start(camera);
      EXPECT_EQ(receiver.wait_for(3).back(), c.format) << c.name;
    }
  });
}

TEST_F(OnFakeCamera, IsFoundByItsAddressAndSerialNumber) {
  run([](FakeGigeCamera&) {
    const auto cameras = find_cameras();
    ASSERT_EQ(cameras.size(), 1U);
    EXPECT_EQ(cameras[0].serial, FakeGigeCamera::kSerial);
    EXPECT_EQ(cameras[0].address, FakeGigeCamera::kAddress);
    for (const std::string& name : {cameras[0].serial, cameras[0].address}) {
      GenicamSettings wanted = settings();
      wanted.camera = name;
      EXPECT_EQ(refusal(wanted, {}), "") << name;
    }
    GenicamSettings missing = settings();
    missing.camera = "24512";
    EXPECT_THAT(refusal(missing, {}), AllOf(HasSubstr("\"24512\" does not answer; there are: \""),
                                            HasSubstr("FAKE7\" at 127.0.0.1")));
    missing.camera = "127.0.0.9";
    EXPECT_THAT(refusal(missing, {}), HasSubstr("no camera answers at 127.0.0.9"));
  });
}

TEST_F(OnFakeCamera, IsListedWithFormatsAndFeatures) {
  run([](FakeGigeCamera&) {
    const auto entries = list_genicam_cameras();
    ASSERT_EQ(entries.size(), 1U);
    EXPECT_EQ(entries[0].problem, "");
    EXPECT_EQ(entries[0].driver, "GigEVision");
    EXPECT_THAT(entries[0].paths, testing::ElementsAre("FAKE7", "127.0.0.1"));
    EXPECT_THAT(entries[0].modes, Contains(AllOf(Field(&CameraMode::format, "Mono16"),
                                                 Field(&CameraMode::size, "1..2048x1..2048"))));
    EXPECT_THAT(
        entries[0].controls,
        Contains(AllOf(Field(&CameraControl::name, "TriggerMode"),
                       Field(&CameraControl::values, testing::ElementsAre("0 = Off", "1 = On")))));
  });
}

TEST_F(OnFakeCamera, RefusesWhatTheCameraHasNotAndSaysWhatItHas) {
  run([](FakeGigeCamera&) {
    EXPECT_THAT(refusal(settings("Mono11"), {}), HasSubstr("must be one of auto, RGB8"));
    EXPECT_THAT(refusal(settings("Mono12p"), {}),
                AllOf(HasSubstr("cannot send Mono12p; it offers"), HasSubstr("Mono16")));
    EXPECT_THAT(refusal(settings(), {4096, 48}),
                HasSubstr("control Width cannot be 4096; it takes 1 to 2048"));
    GenicamSettings outside = settings();
    outside.offset_x = 3000;
    EXPECT_THAT(refusal(outside, {64, 48}), HasSubstr("OffsetX cannot be 3000"));
  });
}

TEST_F(OnFakeCamera, FeaturesHaveTheCamerasLimits) {
  run([](FakeGigeCamera&) {
    GenicamCamera camera(settings());
    configure(camera);
    EXPECT_EQ(refusal(camera.set("ExposureTime", 5000)), "");
    EXPECT_EQ(refusal(camera.set("Gain", 2)), "");
    EXPECT_EQ(refusal(camera.set("GainAuto", 1)), "");
    EXPECT_EQ(refusal(camera.set("BinningHorizontal", 2)), "");
    EXPECT_THAT(refusal(camera.set("ExposureTime", 1)),
                HasSubstr("ExposureTime cannot be 1; it takes 10 to 10000000"));
    EXPECT_THAT(refusal(camera.set("GainRaw", 11)), HasSubstr("it takes 0 to 10"));
    EXPECT_THAT(refusal(camera.set("GainAuto", 2)), HasSubstr("it takes 0 = Off, 1 = Continuous"));
    EXPECT_THAT(refusal(camera.set("TriggerActivation", 9)), HasSubstr("it takes 0 = RisingEdge"));
    EXPECT_THAT(refusal(camera.set("SensorWidth", 9)), HasSubstr("SensorWidth is read only"));
    EXPECT_THAT(
        refusal(camera.set("Emissivity", 1)),
        AllOf(HasSubstr("no control \"Emissivity\"; there are: "), HasSubstr("ExposureTimeAbs")));
  });
}

TEST_F(OnFakeCamera, AThermalCameraSaysTheScaleOfItsCountsAndHasLimitsForItsFeatures) {
  run_with({.is_thermal = true}, [](FakeGigeCamera& fake) {
    GenicamCamera camera(settings("Mono16"));
    configure(camera);
    const auto scale = [&camera] {
      return camera.count_scale().value_or(CountScale{-1, "nothing"});
    };
    EXPECT_EQ(scale().kelvin_per_count, 0);
    EXPECT_EQ(scale().stated_by, "IRFormat is Radiometric");
    ASSERT_EQ(refusal(camera.set("IRFormat", 2)), "");
    EXPECT_EQ(scale().kelvin_per_count, 0.01);
    ASSERT_EQ(refusal(camera.set("IRFormat", 1)), "");
    EXPECT_EQ(scale().kelvin_per_count, 0.1);
    EXPECT_EQ(scale().stated_by, "IRFormat is TemperatureLinear100mK");
    EXPECT_THAT(refusal(camera.set("IRFormat", 3)),
                HasSubstr("IRFormat cannot be 3; it takes 0 = Radiometric, "
                          "1 = TemperatureLinear100mK, 2 = TemperatureLinear10mK"));
    EXPECT_EQ(refusal(camera.set("ObjectEmissivity", 0.85)), "");
    EXPECT_THAT(refusal(camera.set("ObjectEmissivity", 1.2)),
                HasSubstr("ObjectEmissivity cannot be 1.2; it takes 0.01 to 1"));

    Receiver<std::uint64_t> receiver(
        [](const FrameBuffer& frame) { return frame.metadata.sequence; });
    receiver.start(camera);
    EXPECT_THAT(refusal(camera.set("IRFormat", 2)), HasSubstr("it changes what a count means"))
        << "before its stream is open";
    receiver.wait_for(1);
    EXPECT_EQ(refusal(camera.set("IRFormat", 1)), "");
    EXPECT_THAT(refusal(camera.set("IRFormat", 2)), HasSubstr("it changes what a count means"));
    // The camera reconnects as Radiometric, and is set again.
    fake.kill();
    receiver.wait_for_faults(1);
    fake.start();
    receiver.wait_for_return(0);
    EXPECT_EQ(scale().kelvin_per_count, 0.1);
  });
}

TEST_F(OnFakeCamera, SaysNothingOfItsCountsWithoutThermalFeaturesOrInAnotherFormat) {
  run([](FakeGigeCamera&) {
    GenicamCamera camera(settings("Mono16"));
    configure(camera);
    EXPECT_FALSE(camera.count_scale());
  });
  run_with({.is_thermal = true}, [](FakeGigeCamera&) {
    GenicamCamera camera(settings("Mono8"));
    configure(camera);
    EXPECT_FALSE(camera.count_scale());
  });
}

TEST_F(OnFakeCamera, EachSoftwareTriggerExposesOneFrame) {
  run([](FakeGigeCamera&) {
    GenicamCamera camera(settings("Mono16"));
    configure(camera);
    ASSERT_EQ(refusal(camera.set("TriggerMode", 1)), "");
    EXPECT_THAT(refusal(camera.trigger()), HasSubstr("does not run"));
    Receiver<Numbered> receiver(numbered);
    receiver.start(camera);
    ASSERT_TRUE(tests::comes_true([&] { return camera.trigger().has_value(); }));
    const std::size_t triggers = static_cast<std::size_t>(tests::share_of(1000));
    for (std::size_t n = 1; n <= triggers; ++n) {
      ASSERT_EQ(receiver.wait_for(n).size(), n);
      if (n == triggers) break;
      ASSERT_EQ(refusal(camera.trigger()), "");
    }
    camera.stop();
    const auto frames = receiver.wait_for(triggers);
    EXPECT_EQ(frames.size(), triggers);
    EXPECT_EQ(frames.back().sequence - frames.front().sequence, triggers - 1);
  });
}

TEST_F(OnFakeCamera, AndAColourCameraAreSynchronisedByTheirStampsAndTheSkewIsSaid) {
  run([](FakeGigeCamera&) {
    constexpr double kRate = 25;
    constexpr std::size_t kPairs = 20;
    GenicamCamera thermal(settings("Mono16"));
    configure(thermal, {64, 48, kRate});
    const auto colour = make_camera(
        TestPatternSettings{.name = "colour", .pixel_format = PixelFormat::Rgb}, CameraContext{});
    configure(*colour, {64, 48, kRate});
    // Half a period: each frame has one partner, for any phase between the cameras.
    FrameSync sync(2, {.window = 20ms, .max_wait = 100ms});
    const auto start = [&sync](Camera& camera, std::size_t index) {
      EXPECT_TRUE(camera.start([&sync, index](Frame frame) { sync.put(index, std::move(frame)); },
                               [&sync, index](const FaultReport&) { sync.clear(index); }));
    };
    start(thermal, 0);
    start(*colour, 1);
    std::size_t pairs = 0;
    for (const TimePoint guard = Clock::now() + 60s; pairs < kPairs;) {
      const auto set = sync.next(guard);
      ASSERT_TRUE(set) << pairs << " pairs";
      const bool is_pair = set->frames[0] && set->frames[1] && !set->held[0] && !set->held[1];
      if (!is_pair) continue;
      ++pairs;
      EXPECT_NE(set->frames[0]->metadata.stamp_source, StampSource::Arrival);
      EXPECT_EQ(set->skew, std::max(set->age(0), set->age(1)) - std::min(set->age(0), set->age(1)));
      EXPECT_LE(set->skew, 20ms);
    }
    thermal.stop();
    colour->stop();
  });
}

/// Sequence numbers of all frames that the camera sent.
class Witnessed {
 public:
  explicit Witnessed(Camera& camera) {
    camera.set_gate([this](FrameMetadata& metadata) {
      {
        const std::lock_guard lock(mutex_);
        sequences_.push_back(metadata.sequence);
      }
      changed_.notify_all();
      return true;
    });
  }

  std::vector<std::uint64_t> wait_for(std::size_t count) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, 60s, [&] { return sequences_.size() >= count; }));
    return sequences_;
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::uint64_t> sequences_;
};

class LostPackets : public OnFakeCamera, public testing::WithParamInterface<double> {};

TEST_P(LostPackets, CostTheirFramesWhichAreCountedAndNeverDelivered) {
  constexpr std::size_t kFrames = 200;
  constexpr int kPackets = 30;  // packets of a frame, including its first and last one
  run(
      [&](FakeGigeCamera&) {
        GenicamCamera camera(settings("Mono16"));
        configure(camera, {160, 120, 250});
        Witnessed witnessed(camera);
        Receiver<Numbered> receiver(numbered);
        receiver.start(camera);
        const auto sequences = witnessed.wait_for(kFrames);
        camera.stop();
        // On a busy machine a frame may find no buffer; then its packets are counted.
        const std::uint64_t gaps = sequences.back() - sequences.front() + 1 - sequences.size();
        EXPECT_LE(gaps, camera.link_counts().underruns) << "a frame is neither there nor counted";
        const auto frames = receiver.wait_for(0);
        for (const Numbered& frame : frames) {
          ASSERT_TRUE(frame.id) << "an incomplete frame was delivered";
          EXPECT_TRUE(frame.follows(frames.front())) << "frame " << frame.sequence;
        }
        const double expected = kFrames * (1 - std::pow(1 - GetParam() / 1000, kPackets));
        const auto damaged = static_cast<double>(camera.quality().damaged);
        EXPECT_NEAR(damaged, expected, 4 * std::sqrt(expected) + 2);
        EXPECT_EQ(camera.link_counts().missing_packets > 0, damaged > 0);
      },
      GetParam());
}
INSTANTIATE_TEST_SUITE_P(PerThousand, LostPackets, testing::Values(0, 1, 10, 100));

TEST_F(OnFakeCamera, AnotherHostsCameraIsRefused) {
  run([](FakeGigeCamera&) {
    GenicamCamera camera(settings());
    configure(camera);
    EXPECT_THAT(refusal(settings(), {}), HasSubstr("under the control of another host"));
  });
}

class SentAgain : public testing::TestWithParam<double> {};

TEST_P(SentAgain, EveryFrameIsWhole) {
  ORBWATCH_REQUIRE_NETWORK_NAMESPACES();
  constexpr std::size_t kFrames = 50;
  const tests::NetworkNamespace ours, theirs;
  const tests::Cable cable(ours, theirs);
  std::optional<FakeGigeCamera> fake;
  std::optional<tests::ResendingProxy> proxy;
  theirs.run([&] {
    fake.emplace(FakeGigeCamera::Options{});
    proxy.emplace(tests::Cable::kRight, GetParam());
  });
  ours.run([&] {
    GenicamSettings settings;
    settings.camera = tests::Cable::kRight;
    settings.pixel_format = "Mono16";
    GenicamCamera camera(settings);
    const auto format = camera.configure({320, 240, 25});
    ASSERT_TRUE(format) << format.error().message;
    Receiver<Numbered> receiver(numbered);
    receiver.start(camera);
    const auto frames = receiver.wait_for(kFrames);
    camera.stop();
    for (const Numbered& frame : frames) {
      ASSERT_TRUE(frame.id) << "frame " << frame.sequence;
      EXPECT_TRUE(frame.follows(frames.front())) << "frame " << frame.sequence;
    }
    // On a busy machine a socket overflows now and then, which costs a frame.
    const std::uint64_t gaps = frames.back().sequence - frames.front().sequence + 1 - frames.size();
    EXPECT_LE(4 * gaps, static_cast<std::uint64_t>(proxy->injured()));
    EXPECT_LE(camera.quality().damaged, gaps + 1) << "the last frame may be incomplete";
    EXPECT_EQ(camera.link_counts().missing_packets > 0, camera.quality().damaged > 0);
    EXPECT_GT(proxy->injured(), 5) << "of " << kFrames << " frames of 115 packets";
    EXPECT_GT(camera.link_counts().resent_packets, 0U);
  });
}
INSTANTIATE_TEST_SUITE_P(PerThousand, SentAgain, testing::Values(3, 10));

TEST(OverACable, IsFoundBySerialNumberAndComesBackWhenItIsPluggedOrMoves) {
  ORBWATCH_REQUIRE_NETWORK_NAMESPACES();
  const tests::NetworkNamespace ours, theirs;
  const tests::Cable cable(ours, theirs);
  std::optional<FakeGigeCamera> fake;
  theirs.run([&] { fake.emplace(FakeGigeCamera::Options{0, "wire", tests::Cable::kRight}); });
  ours.run([&] {
    GenicamSettings settings;
    settings.camera = FakeGigeCamera::kSerial;
    settings.pixel_format = "Mono16";
    GenicamCamera camera(settings);
    const auto format = camera.configure({160, 120, 100});
    ASSERT_TRUE(format) << format.error().message;
    Receiver<Numbered> receiver(numbered);
    receiver.start(camera);
    for (const Numbered& frame : receiver.wait_for(20)) EXPECT_TRUE(frame.id);
    // Aravis needs five seconds to close a camera that does not answer.
    if (!tests::acceptance_mode()) return;
    cable.pull();
    EXPECT_EQ(receiver.wait_for_faults(1)[0].fault, Fault::Unplugged);
    cable.plug();
    const std::size_t seen = receiver.wait_for_return(0).size();
    theirs.run([&] {
      tests::ip("address flush dev wire");
      tests::ip("address add 10.77.0.9/24 dev wire");
      fake->move_to("10.77.0.9");
    });
    receiver.wait_for_return(seen);
    EXPECT_TRUE(receiver.wait_for(receiver.count() + 1).back().id);
  });
}

std::size_t open_files() {
  const std::filesystem::directory_iterator first("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(first), end(first)));
}

TEST_F(OnFakeCamera, ComesBackWithItsFeaturesWhenTheCameraWasRestarted) {
  run([](FakeGigeCamera& fake) {
    GenicamCamera camera(settings("Mono16"));
    configure(camera);
    ASSERT_EQ(refusal(camera.set("ExposureTime", 20000)), "");
    Receiver<std::chrono::microseconds> receiver(
        [](const FrameBuffer& frame) { return frame.metadata.exposure_time; });
    receiver.start(camera);
    receiver.wait_for(1);
    const std::size_t files = open_files();
    const int restarts = tests::share_of(10);
    std::size_t seen = 0;
    for (int round = 0; round < restarts; ++round) {
      fake.kill();
      EXPECT_NE(receiver.wait_for_faults(seen + 1).back().fault, Fault::None);
      fake.start();
      seen = receiver.wait_for_return(seen).size();
      EXPECT_EQ(receiver.wait_for(receiver.count() + 1).back(), 20ms);
      EXPECT_EQ(open_files(), files);
    }
  });
}

TEST_F(OnFakeCamera, AFeatureThatIsSetWhileTheCameraIsAwayIsSetWhenItComesBack) {
  run([](FakeGigeCamera& fake) {
    GenicamCamera camera(settings("Mono16"));
    configure(camera);
    ASSERT_EQ(refusal(camera.set("ExposureTime", 20000)), "");
    Receiver<std::chrono::microseconds> receiver(
        [](const FrameBuffer& frame) { return frame.metadata.exposure_time; });
    receiver.start(camera);
    receiver.wait_for(1);
    fake.kill();
    ASSERT_TRUE(tests::comes_true(
        [&] { return receiver.wait_for_faults(1).back().fault == Fault::Unplugged; }));
    EXPECT_EQ(refusal(camera.set("ExposureTime", 30000)), "");
    fake.start();
    receiver.wait_for_return(0);
    EXPECT_EQ(receiver.wait_for(receiver.count() + 1).back(), 30ms);
  });
}

}  // namespace
}  // namespace orbwatch::hal
