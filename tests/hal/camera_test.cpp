#include "hal/camera.h"

#include <gtest/gtest.h>

#include <future>
#include <vector>

#include "hal/frame/frame_pool.h"

namespace orbwatch::hal {
namespace {

/// The smallest back-end: one grey pixel as fast as it is consumed.
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

TEST(Camera, SaysWhatItCannotDo) {
  CountingCamera camera;
  EXPECT_FALSE(camera.trigger());
  const auto result = camera.set("ExposureTime", 1.0);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("ExposureTime"), std::string::npos);
}

}  // namespace
}  // namespace orbwatch::hal
