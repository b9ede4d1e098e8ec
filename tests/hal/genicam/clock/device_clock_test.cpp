// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/clock/device_clock.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;
using std::chrono::nanoseconds;

/// Camera of 25 frames per second whose clock drifts and whose frames arrive late.
class SimulatedCamera {
 public:
  static constexpr nanoseconds kPeriod = 40ms;
  static constexpr nanoseconds kLeastDelay = 300us;

  explicit SimulatedCamera(double drift) : drift_(drift) {}

  /// Start of frame `n`, on both clocks.
  TimePoint exposure(int n) const { return TimePoint(1000s) + n * kPeriod; }
  nanoseconds stamp(int n) const {
    const double elapsed = static_cast<double>(((n - set_at_) * kPeriod).count());
    return set_to_ + nanoseconds(std::llround(elapsed * (1 + drift_)));
  }
  void set_clock(int n, nanoseconds device) {
    set_at_ = n;
    set_to_ = device;
  }

  /// Most frames are late by tenths of a millisecond, some by ten.
  nanoseconds delay() {
    std::exponential_distribution<double> usual(1 / 200e3), rare(1 / 5e6);
    const bool held_up = std::bernoulli_distribution(0.05)(random_);
    return kLeastDelay + nanoseconds(std::llround(held_up ? rare(random_) : usual(random_)));
  }

 private:
  double drift_;
  int set_at_ = 0;
  nanoseconds set_to_ = 5'000'000s;
  std::mt19937 random_{7};
};

nanoseconds error_of(const DeviceClock& clock, const SimulatedCamera& camera, int n) {
  return *clock.to_steady(camera.stamp(n)) - camera.exposure(n) - SimulatedCamera::kLeastDelay;
}

/// Runs frames [from, to); returns the largest error of the frames from `settled` on.
nanoseconds run(DeviceClock& clock, SimulatedCamera& camera, int from, int to, int settled) {
  nanoseconds largest{0};
  for (int n = from; n < to; ++n) {
    clock.add_arrival(camera.stamp(n), camera.exposure(n) + camera.delay());
    if (n >= settled) largest = std::max(largest, std::chrono::abs(error_of(clock, camera, n)));
  }
  return largest;
}

TEST(DeviceClock, KnowsNothingBeforeTheFirstMoment) {
  const DeviceClock clock;
  EXPECT_FALSE(clock.to_steady(5s));
  EXPECT_FALSE(clock.residual());
}

TEST(DeviceClock, TheFirstFrameIsAtItsArrival) {
  DeviceClock clock;
  clock.add_arrival(5s, TimePoint(100s));
  EXPECT_EQ(clock.to_steady(5s), TimePoint(100s));
  EXPECT_EQ(clock.to_steady(6s), TimePoint(101s));
}

class Drift : public testing::TestWithParam<double> {};

TEST_P(Drift, IsFollowedAndDelaysThatVaryAreRemoved) {
  DeviceClock clock;
  SimulatedCamera camera(GetParam());
  const nanoseconds settled = run(clock, camera, 0, 25 * 600, 25 * 10);
  EXPECT_LT(settled, 250us) << "of delays up to " << 10ms;
  ASSERT_TRUE(clock.residual());
  EXPECT_GT(*clock.residual(), 0ns);
  EXPECT_LT(*clock.residual(), 100us);
  EXPECT_EQ(clock.jumps(), 0U);
}
INSTANTIATE_TEST_SUITE_P(Crystals, Drift, testing::Values(0.0, 20e-6, -20e-6, 100e-6, -100e-6));

TEST(DeviceClock, StartsAnewWhenTheCamerasClockWasSet) {
  for (const nanoseconds device : {nanoseconds(0), nanoseconds(6'000'000s)}) {
    DeviceClock clock;
    SimulatedCamera camera(30e-6);
    run(clock, camera, 0, 1000, 1000);
    camera.set_clock(1000, device);
    EXPECT_LT(run(clock, camera, 1000, 1002, 1000), 30ms) << "the first frame after it";
    EXPECT_LT(run(clock, camera, 1002, 2000, 1250), 250us);
    EXPECT_EQ(clock.jumps(), 1U);
  }
}

TEST(DeviceClock, FindsAStepThatNoSingleFrameShows) {
  DeviceClock clock;
  SimulatedCamera camera(0);
  run(clock, camera, 0, 1000, 1000);
  camera.set_clock(1000, camera.stamp(1000) - 30ms);
  EXPECT_LT(run(clock, camera, 1000, 2000, 1100), 250us);
  EXPECT_EQ(clock.jumps(), 1U);
}

TEST(DeviceClock, AFrameThatWasHeldUpForSecondsMovesNothing) {
  DeviceClock clock;
  SimulatedCamera camera(30e-6);
  run(clock, camera, 0, 1000, 1000);
  clock.add_arrival(camera.stamp(1000), camera.exposure(1000) + 5s);
  EXPECT_LT(std::chrono::abs(error_of(clock, camera, 1000)), 250us);
  EXPECT_EQ(clock.jumps(), 0U);
}

TEST(DeviceClock, ALatchedClockIsKnownToHalfARoundTrip) {
  DeviceClock clock;
  SimulatedCamera camera(80e-6);
  std::mt19937 random(3);
  std::uniform_int_distribution<int> way(50'000, 250'000);
  nanoseconds largest{0};
  for (int n = 0; n < 25 * 60; n += 25) {
    clock.add_latched(camera.stamp(n), camera.exposure(n) - nanoseconds(way(random)),
                      camera.exposure(n) + nanoseconds(way(random)));
    for (int frame = n; n >= 75 && frame < n + 25; ++frame) {
      largest = std::max(largest, std::chrono::abs(*clock.to_steady(camera.stamp(frame)) -
                                                   camera.exposure(frame)));
    }
  }
  EXPECT_LT(largest, 200us);
  EXPECT_LT(*clock.residual(), 100us);
}

}  // namespace
}  // namespace orbwatch::hal
