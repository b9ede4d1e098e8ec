#include "hal/device_camera.h"

#include <gtest/gtest.h>

#include <condition_variable>
#include <deque>
#include <mutex>
#include <vector>

#include "hal/frame_pool.h"

namespace orbwatch::hal {
namespace {

/// Each time that it is opened the device does the next thing: it fails, after some frames or none.
class BreakingCamera : public DeviceCamera {
 public:
  struct Life {
    std::size_t frames = 0;
    Fault end = Fault::None;
  };

  explicit BreakingCamera(std::deque<Life> lives)
      : DeviceCamera({"breaking", "", "test"}), lives_(std::move(lives)) {}
  ~BreakingCamera() override { stop(); }

 private:
  Result<StreamFormat> do_configure(const StreamRequest&) override { return StreamFormat{}; }

  FaultReport stream_until_fault(const std::stop_token& stop) override {
    if (lives_.empty()) {
      wait_until(stop, TimePoint::max());
      return {};
    }
    const Life life = lives_.front();
    lives_.pop_front();
    counter_.restart();
    for (std::uint32_t n = 0; n < life.frames; ++n) {
      auto frame = pool_.acquire();
      frame->metadata.sequence = counter_.number(n);
      hand_on(std::move(frame));
    }
    return {life.end, "as told"};
  }

  FramePool pool_ = make_frame_pool(PixelFormat::Grey, 8, 8);
  std::deque<Life> lives_;
};

/// What a camera told.
class Told {
 public:
  void start(Camera& camera) {
    ASSERT_TRUE(camera.configure({}));
    ASSERT_TRUE(camera.start(
        [this](const Frame& frame) {
          const std::lock_guard lock(mutex_);
          sequences_.push_back(frame->metadata.sequence);
        },
        [this](const FaultReport& report) {
          const std::lock_guard lock(mutex_);
          faults_.push_back(report.fault);
          changed_.notify_all();
        }));
  }
  std::vector<Fault> wait_for_faults(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::seconds(60), [&] { return faults_.size() >= count; });
    return faults_;
  }
  const std::vector<std::uint64_t>& sequences() const { return sequences_; }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Fault> faults_;
  std::vector<std::uint64_t> sequences_;
};

TEST(DeviceCamera, ComesBackAndNumbersItsFramesOn) {
  BreakingCamera camera({{0, Fault::Unplugged}, {2, Fault::ReadError}, {2, Fault::Stalled}});
  Told told;
  told.start(camera);
  EXPECT_EQ(told.wait_for_faults(5), (std::vector{Fault::Unplugged, Fault::None, Fault::ReadError,
                                                  Fault::None, Fault::Stalled}));
  camera.stop();
  const auto& sequences = told.sequences();
  ASSERT_EQ(sequences.size(), 4U);
  for (std::size_t i = 1; i < sequences.size(); ++i) EXPECT_GT(sequences[i], sequences[i - 1]);
}

TEST(DeviceCamera, TellsOfAFaultThatLastsOnce) {
  BreakingCamera camera({{0, Fault::Unplugged}, {0, Fault::Unplugged}, {1, Fault::Stalled}});
  Told told;
  told.start(camera);
  EXPECT_EQ(told.wait_for_faults(3), (std::vector{Fault::Unplugged, Fault::None, Fault::Stalled}));
}

}  // namespace
}  // namespace orbwatch::hal
