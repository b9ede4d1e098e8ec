// SPDX-License-Identifier: Apache-2.0
#include "hal/device_camera.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <string_view>
#include <thread>
#include <vector>

#include "hal/frame/frame_pool.h"

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

/// Device with one life per opening: it delivers frames, then fails or is silent.
class BreakingCamera : public DeviceCamera {
 public:
  struct Life {
    std::size_t frames = 0;
    Fault end = Fault::None;  ///< None: it is silent from then on
    bool may_be_silent = false;
    bool lost = false;
  };

  explicit BreakingCamera(std::deque<Life> lives)
      : DeviceCamera({"breaking", "", "test"}), lives_(std::move(lives)) {}
  ~BreakingCamera() override { stop(); }

  void connect(bool connected) { connected_ = connected; }
  /// Gain that was set when each frame was captured. Call after stop().
  const std::vector<double>& gains() const { return gains_; }
  int waits() const { return waits_; }  ///< number of waits that began
  int interrupts() const {
    const std::lock_guard lock(mutex_);
    return interrupts_;
  }

 private:
  Result<StreamFormat> do_configure(const StreamRequest&) override { return StreamFormat{}; }

  Result<> do_set(std::string_view, double value) override {
    if (!connected_) return fail("is not connected");
    if (value < 0) return fail("gain is below 0");
    gain_ = value;
    return {};
  }

  DeviceResult<double> open_stream() override {
    if (!connected_) return tl::unexpected(FaultReport{Fault::Unplugged, "is not connected"});
    captured_ = 0;
    life_ = {.may_be_silent = true};
    if (lives_.empty()) return 0;
    life_ = lives_.front();
    lives_.pop_front();
    if (life_.frames == 0) return tl::unexpected(FaultReport{life_.end, "as scripted"});
    return kFrameRate;
  }

  DeviceResult<std::size_t> capture(TimePoint deadline) override {
    if (captured_ == life_.frames) {
      if (life_.end != Fault::None) return tl::unexpected(FaultReport{life_.end, "as scripted"});
      ++waits_;
      std::unique_lock lock(mutex_);
      interrupted_.wait_until(lock, deadline, [this] { return interrupts_ > 0; });
      return 0;
    }
    auto frame = pool_.acquire();
    frame->metadata.sequence = sequence_of(static_cast<std::uint32_t>(captured_));
    gains_.push_back(gain_);
    forward(std::move(frame));
    ++captured_;
    return 1;
  }

  bool may_be_silent() const override { return life_.may_be_silent; }
  /// Ends a wait; there is no other way, as for a device that is polled.
  void interrupt() override {
    const std::lock_guard lock(mutex_);
    ++interrupts_;
    interrupted_.notify_all();
  }

  DeviceResult<> close_stream() override {
    if (life_.lost) return tl::unexpected(FaultReport{Fault::Unplugged, "lost for good"});
    return {};
  }

  static constexpr double kFrameRate = 100;

  FramePool pool_ = make_frame_pool(PixelFormat::Grey, 8, 8);
  std::deque<Life> lives_;
  std::atomic<bool> connected_ = true;
  std::atomic<double> gain_ = 0;
  std::vector<double> gains_;
  std::atomic<int> waits_ = 0;
  mutable std::mutex mutex_;
  std::condition_variable interrupted_;
  int interrupts_ = 0;
  Life life_;
  std::size_t captured_ = 0;
};

/// Reports and frames of a camera.
class Reports {
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

TEST(DeviceCamera, ReconnectsAndContinuesItsSequence) {
  BreakingCamera camera({{0, Fault::Unplugged}, {2, Fault::ReadError}, {2, Fault::Stalled}});
  Reports reports;
  reports.start(camera);
  EXPECT_EQ(
      reports.wait_for_faults(5),
      (std::vector{Fault::Unplugged, Fault::None, Fault::ReadError, Fault::None, Fault::Stalled}));
  camera.stop();
  const auto& sequences = reports.sequences();
  ASSERT_EQ(sequences.size(), 4U);
  for (std::size_t i = 1; i < sequences.size(); ++i) EXPECT_GT(sequences[i], sequences[i - 1]);
}

TEST(DeviceCamera, ReportsALastingFaultOnce) {
  BreakingCamera camera({{0, Fault::Unplugged}, {0, Fault::Unplugged}, {1, Fault::Stalled}});
  Reports reports;
  reports.start(camera);
  EXPECT_EQ(reports.wait_for_faults(3),
            (std::vector{Fault::Unplugged, Fault::None, Fault::Stalled}));
}

TEST(DeviceCamera, ControlsSetWhileItIsUnpluggedAreSetBeforeTheNextFrame) {
  BreakingCamera camera({{2, Fault::Stalled}});
  EXPECT_TRUE(camera.set("Gain", 1));
  camera.connect(false);
  EXPECT_FALSE(camera.set("Gain", 2)) << "it does not run yet";
  Reports reports;
  reports.start(camera);
  EXPECT_EQ(reports.wait_for_faults(1), std::vector{Fault::Unplugged});
  EXPECT_TRUE(camera.set("Gain", 3));
  EXPECT_TRUE(camera.set("Gain", 4));
  camera.connect(true);
  EXPECT_EQ(reports.wait_for_faults(3),
            (std::vector{Fault::Unplugged, Fault::None, Fault::Stalled}));
  EXPECT_FALSE(camera.set("Gain", -1)) << "it is there again";
  camera.stop();
  EXPECT_EQ(camera.gains(), (std::vector<double>{4, 4}));
}

TEST(DeviceCamera, AKeptControlThatItRefusesIsAFaultUntilAnotherValueIsSet) {
  BreakingCamera camera({{1, Fault::None}, {1, Fault::Stalled}});
  camera.connect(false);
  Reports reports;
  reports.start(camera);
  reports.wait_for_faults(1);
  EXPECT_TRUE(camera.set("Gain", -1));
  camera.connect(true);
  EXPECT_EQ(reports.wait_for_faults(2), (std::vector{Fault::Unplugged, Fault::Refused}));
  EXPECT_TRUE(camera.set("Gain", 5));
  EXPECT_EQ(reports.wait_for_faults(4),
            (std::vector{Fault::Unplugged, Fault::Refused, Fault::None, Fault::Stalled}));
  camera.stop();
  EXPECT_EQ(camera.gains(), std::vector<double>{5});
}

TEST(StallTimeout, IsFivePeriodsAndASecondAtLeast) {
  EXPECT_EQ(stall_timeout(60), 1s);
  EXPECT_EQ(stall_timeout(5), 1s);
  EXPECT_EQ(stall_timeout(0.5), 10s);
  EXPECT_EQ(stall_timeout(0), 5s);
}

TEST(DeviceCamera, ReportsASilentDeviceAsStalled) {
  BreakingCamera camera({{.frames = 1}, {.frames = 1, .end = Fault::ReadError}});
  Reports reports;
  reports.start(camera);
  EXPECT_EQ(reports.wait_for_faults(3),
            (std::vector{Fault::Stalled, Fault::None, Fault::ReadError}));
}

TEST(DeviceCamera, AllowsSilenceOfADeviceThatWaits) {
  BreakingCamera camera({{.frames = 1, .may_be_silent = true}});
  Reports reports;
  reports.start(camera);
  while (camera.waits() < 2) std::this_thread::yield();
  camera.stop();
  EXPECT_EQ(reports.wait_for_faults(0), std::vector<Fault>());
  EXPECT_EQ(camera.interrupts(), 1);
}

TEST(DeviceCamera, ReportsTheErrorOfClosingInsteadOfTheStreams) {
  BreakingCamera camera({{.frames = 1, .end = Fault::ReadError, .lost = true}});
  Reports reports;
  reports.start(camera);
  EXPECT_EQ(reports.wait_for_faults(1), std::vector{Fault::Unplugged});
}

}  // namespace
}  // namespace orbwatch::hal
