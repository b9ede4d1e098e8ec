// SPDX-License-Identifier: Apache-2.0
#include "hal/camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <future>
#include <iterator>
#include <vector>

#include "hal/frame/frame_pool.h"

namespace orbwatch::hal {
namespace {

/// Smallest back-end: one grey pixel as fast as it is consumed.
class CountingCamera : public Camera {
 public:
  CountingCamera() : Camera({"counting", "counter", "test"}) {}
  ~CountingCamera() override { stop(); }

 private:
  Result<StreamFormat> do_configure(const StreamRequest& request) override {
    if (request.width > 1) return fail("counting: has one pixel");
    return StreamFormat{PixelFormat::Grey, {}, 1, 1, 1000.0};
  }
  void run(const std::stop_token&) override {
    std::uint64_t sequence = 0;
    while (wait_until(Clock::now() + std::chrono::microseconds(100))) {
      if (auto buffer = pool_.acquire()) {
        buffer->metadata.sequence = sequence++;
        report(sequence % 4 == 0 ? Fault::ReadError : Fault::None);
        deliver(buffer);
      }
    }
  }
  FramePool pool_ = make_frame_pool(PixelFormat::Grey, 1, 1);
};

void ignore_fault(const FaultReport&) {}

TEST(Camera, RefusesToStartUnconfigured) {
  CountingCamera camera;
  EXPECT_FALSE(camera.start([](const Frame&) {}, ignore_fault));
  EXPECT_FALSE(camera.configure({.width = 2}));
  EXPECT_FALSE(camera.start([](const Frame&) {}, ignore_fault));
}

TEST(Camera, RefusesNoBuffersAndMoreThanItsBackEndsCount) {
  CountingCamera camera;
  EXPECT_TRUE(camera.configure({.buffers = 1}));
  EXPECT_TRUE(camera.configure({.buffers = kMaxBuffers}));
  EXPECT_FALSE(camera.configure({.buffers = 0}));
  EXPECT_FALSE(camera.configure({.buffers = kMaxBuffers + 1}));
}

TEST(Camera, GivesANoticeWhenItChanges) {
  class Noticing : public Camera {
   public:
    Noticing() : Camera({"noticing", "noticing", "test"}) {}
    ~Noticing() override { stop(); }
    std::promise<void> said;

   private:
    Result<StreamFormat> do_configure(const StreamRequest&) override { return StreamFormat{}; }
    void run(const std::stop_token&) override {
      for (const char* text : {"a", "a", "b", "b", "a"}) notify(text);
      said.set_value();
    }
  };
  Noticing camera;
  std::vector<std::string> notices;
  camera.set_on_notice([&notices](const std::string& text) { notices.push_back(text); });
  ASSERT_TRUE(camera.configure({}));
  ASSERT_TRUE(camera.start([](const Frame&) {}, ignore_fault));
  camera.said.get_future().wait();
  camera.stop();
  EXPECT_EQ(notices, (std::vector<std::string>{"a", "b", "a"}));
}

TEST(Camera, AGateWithholdsFramesAndCompletesTheOthers) {
  CountingCamera camera;
  ASSERT_TRUE(camera.configure({}));
  std::uint64_t asked = 0;
  camera.set_gate([&asked](FrameMetadata& metadata) {
    metadata.trigger = ++asked;
    return asked % 3 == 0;
  });
  std::promise<void> reached;
  std::vector<std::uint64_t> triggers, sequences;
  ASSERT_TRUE(camera.start(
      [&](const Frame& frame) {
        if (triggers.size() == 5) return;
        triggers.push_back(frame->metadata.trigger.value());
        sequences.push_back(frame->metadata.sequence);
        if (triggers.size() == 5) reached.set_value();
      },
      ignore_fault));
  reached.get_future().wait();
  camera.stop();
  EXPECT_EQ(triggers, (std::vector<std::uint64_t>{3, 6, 9, 12, 15}));
  EXPECT_EQ(sequences, (std::vector<std::uint64_t>{0, 1, 2, 3, 4})) << "withheld ones are not lost";
}

TEST(Camera, DeliversAgainAfterARestartAndNothingAfterStop) {
  CountingCamera camera;
  ASSERT_TRUE(camera.configure({}));
  for (int round = 0; round < 3; ++round) {
    std::promise<void> reached;
    std::atomic<int> frames{0};
    ASSERT_TRUE(camera.start(
        [&](const Frame&) {
          if (++frames == 10) reached.set_value();
        },
        ignore_fault));
    EXPECT_FALSE(camera.start([](const Frame&) {}, ignore_fault)) << "started twice";
    EXPECT_FALSE(camera.configure({})) << "configured while running";
    reached.get_future().wait();
    camera.stop();
    camera.stop();
    const int at_stop = frames;
    EXPECT_GE(at_stop, 10);
    EXPECT_EQ(frames, at_stop);
  }
}

TEST(Camera, StopsInsideItsOwnCallback) {
  CountingCamera camera;
  ASSERT_TRUE(camera.configure({}));
  std::promise<void> stopped;
  int frames = 0;
  ASSERT_TRUE(camera.start(
      [&](const Frame&) {
        if (++frames == 5) {
          camera.stop();
          stopped.set_value();
        }
      },
      ignore_fault));
  stopped.get_future().wait();
  camera.stop();
  EXPECT_EQ(frames, 5);
}

TEST(Camera, ReportsAFaultOncePerChange) {
  CountingCamera camera;
  ASSERT_TRUE(camera.configure({}));
  std::vector<Fault> faults;
  std::promise<void> reached;
  ASSERT_TRUE(camera.start([](const Frame&) {},
                           [&](const FaultReport& report) {
                             faults.push_back(report.fault);
                             if (faults.size() == 4) reached.set_value();
                           }));
  reached.get_future().wait();
  camera.stop();
  EXPECT_EQ(faults[0], Fault::ReadError);
  EXPECT_EQ(faults[1], Fault::None);
  EXPECT_EQ(faults[2], Fault::ReadError);
}

/// Camera that plays a script: '.' is an intact frame, 'f' a flawed and 'd' a damaged one, 'a' one
/// without a stamp, 'u' an unplugged camera and '_' a second without frames.
class PlayingCamera : public Camera {
 public:
  explicit PlayingCamera(std::string script)
      : Camera({"playing", "player", "test"}), script_(std::move(script)) {}
  ~PlayingCamera() override { stop(); }

  /// Plays the script to its end.
  void play() {
    ASSERT_TRUE(configure({}));
    ASSERT_TRUE(start([this](const Frame& frame) { frames.push_back(frame->metadata); },
                      [this](const FaultReport& fault) { faults.push_back(fault.fault); }));
    played_.get_future().wait();
    stop();
  }

  std::vector<FrameMetadata> frames;
  std::vector<Fault> faults;

 private:
  Result<StreamFormat> do_configure(const StreamRequest&) override { return StreamFormat{}; }
  void run(const std::stop_token&) override {
    FrameMetadata metadata;
    for (const char step : script_) {
      metadata.exposure_start += std::chrono::milliseconds(step == '_' ? 1000 : 33);
      if (step == 'u') report(Fault::Unplugged);
      if (step == '_' || step == 'u') continue;
      if (step == 'd') {
        discard(metadata, "as scripted");
      } else {
        auto buffer = pool_.acquire();
        buffer->metadata = metadata;
        if (step == 'f') buffer->metadata.status = FrameStatus::Flawed;
        if (step == 'a') buffer->metadata.stamp_source = StampSource::Arrival;
        deliver(std::move(buffer));
      }
      ++metadata.sequence;
    }
    played_.set_value();
  }

  const std::string script_;
  std::promise<void> played_;
  FramePool pool_ = make_frame_pool(PixelFormat::Grey, 1, 1);
};

std::vector<std::uint64_t> sequences(const std::vector<FrameMetadata>& frames) {
  std::vector<std::uint64_t> numbers;
  std::ranges::transform(frames, std::back_inserter(numbers), &FrameMetadata::sequence);
  return numbers;
}

TEST(Camera, ADamagedFrameCostsItselfOnly) {
  PlayingCamera camera(".d.dd.d.");
  camera.play();
  EXPECT_TRUE(camera.faults.empty());
  EXPECT_EQ(sequences(camera.frames), (std::vector<std::uint64_t>{0, 2, 5, 7}));
  EXPECT_EQ(camera.quality().damaged, 4U);
}

TEST(Camera, ManyDamagedFramesAreOneFaultUntilASecondAfterTheLast) {
  PlayingCamera camera("ddddddd..d.._..");
  camera.play();
  EXPECT_EQ(camera.faults, (std::vector{Fault::CorruptFrame, Fault::None}));
  EXPECT_EQ(sequences(camera.frames), (std::vector<std::uint64_t>{12, 13}));
  EXPECT_EQ(camera.quality().damaged, 8U);
}

TEST(Camera, WithoutTimeStampsIsAFaultWhereTheyAreNeeded) {
  PlayingCamera alone("aaaaaaa");
  alone.play();
  EXPECT_TRUE(alone.faults.empty());
  EXPECT_EQ(alone.frames.size(), 7U);
  PlayingCamera joined(".aaaaaaa.__.");
  joined.require_stamps();
  joined.play();
  EXPECT_EQ(joined.faults, (std::vector{Fault::NoTimeStamps, Fault::None}));
  EXPECT_EQ(sequences(joined.frames), (std::vector<std::uint64_t>{0, 9}));
  PlayingCamera hiccup("..a..a...");
  hiccup.require_stamps();
  hiccup.play();
  EXPECT_TRUE(hiccup.faults.empty()) << "one frame costs itself";
  EXPECT_EQ(hiccup.quality().damaged, 2U);
}

TEST(Camera, DamageOfTwoKindsIsOneFaultWithTheCauseThatRaisedIt) {
  PlayingCamera camera("aaaaadadad.__.");
  camera.require_stamps();
  camera.play();
  EXPECT_EQ(camera.faults, (std::vector{Fault::NoTimeStamps, Fault::None}));
  EXPECT_EQ(camera.quality().damaged, 10U);
}

TEST(Camera, StampsBecomeExposureStartsBeforeTheGateSeesThem) {
  PlayingCamera camera(".d.");
  camera.set_stamps({.readout_time = {}, .offset = std::chrono::milliseconds(3)});
  std::vector<TimePoint> seen;
  camera.set_gate([&seen](FrameMetadata& metadata) {
    seen.push_back(metadata.exposure_start);
    return true;
  });
  camera.play();
  using std::chrono::milliseconds;
  EXPECT_EQ(seen, (std::vector{TimePoint(milliseconds(30)), TimePoint(milliseconds(63)),
                               TimePoint(milliseconds(96))}));
}

TEST(Camera, AnotherFaultForgetsDamagedFrames) {
  PlayingCamera camera("dddddu.ddd.");
  camera.play();
  EXPECT_EQ(camera.faults, (std::vector{Fault::CorruptFrame, Fault::Unplugged, Fault::None}));
  EXPECT_EQ(sequences(camera.frames), (std::vector<std::uint64_t>{5, 9}));
}

TEST(Camera, AsksTheGateAboutFramesThatAreWithheld) {
  PlayingCamera camera(".d.ddddd.");
  std::vector<FrameStatus> asked;
  camera.set_gate([&asked](FrameMetadata& metadata) {
    asked.push_back(metadata.status);
    return asked.size() != 2;
  });
  camera.play();
  std::vector<FrameStatus> expected(9, FrameStatus::Withheld);
  expected[0] = expected[2] = FrameStatus::Intact;
  EXPECT_EQ(asked, expected);
  EXPECT_EQ(sequences(camera.frames), (std::vector<std::uint64_t>{0, 1}))
      << "the damaged frame was never asked for, so it is not lost";
}

TEST(Camera, DeliversAndCountsFlawedFrames) {
  PlayingCamera camera("f.ff");
  camera.play();
  EXPECT_TRUE(camera.faults.empty());
  EXPECT_EQ(camera.frames.size(), 4U);
  EXPECT_EQ(camera.quality().flawed, 3U);
  EXPECT_EQ(camera.quality().damaged, 0U);
}

TEST(Camera, SaysWhatItCannotDo) {
  CountingCamera camera;
  EXPECT_FALSE(camera.trigger());
  const auto result = camera.set("ExposureTime", 1.0);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("ExposureTime"), std::string::npos);
}

}  // namespace
}  // namespace orbwatch::hal
