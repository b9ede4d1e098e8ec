// SPDX-License-Identifier: Apache-2.0
#include "app/machine/controller_clock.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/app/machine/moments.h"

namespace orbwatch::app::machine {
namespace {

using tests::at_s;

using Double = std::chrono::duration<double>;

/// Worst error of the moments, s, of messages every 20 ms that are up to `jitter` late, after the
/// first second; `clock` is the controller's for a moment of ours.
template <class Clock>
double worst_error(ControllerClock& tested, double begin, double end, double jitter, Clock clock) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> late(0, jitter);
  double worst = 0, newest = 0;
  for (double t = begin; t < end; t += 0.02) {
    newest = std::max(newest, t + late(random));  // messages keep their order
    const double error = Double(tested.moment_of(clock(t), at_s(newest)) - at_s(t)).count();
    if (t > begin + 1) worst = std::max(worst, std::abs(error));
  }
  return worst;
}

TEST(ControllerClock, TheJitterOfMessagesIsGone) {
  ControllerClock clock;
  EXPECT_LT(worst_error(clock, 1000, 1060, 0.02, [](double t) { return t - 950; }), 0.002);
}

TEST(ControllerClock, FollowsAClockThatDrifts) {
  ControllerClock clock;
  const auto fast = [](double t) { return 1.0001 * t; };
  EXPECT_LT(worst_error(clock, 1000, 1600, 0.01, fast), 0.002);
  ControllerClock other;
  const auto slow = [](double t) { return 0.9999 * t; };
  EXPECT_LT(worst_error(other, 1000, 1600, 0.01, slow), 0.002);
}

TEST(ControllerClock, AClockThatIsSetBeginsAnew) {
  ControllerClock clock;
  worst_error(clock, 1000, 1010, 0.01, [](double t) { return t; });
  for (const double step : {86400.0, -900.0, 5000.0}) {
    EXPECT_LT(worst_error(clock, 1010, 1015, 0.01, [step](double t) { return t + step; }), 0.003)
        << step;
  }
}

TEST(ControllerClock, NoMomentIsLaterThanItsArrival) {
  ControllerClock clock;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(0, 4e9);
  for (int n = 0; n < 1000; ++n) {
    const hal::TimePoint arrival = at_s(1000 + n * 0.01);
    EXPECT_LE(clock.moment_of(any(random), arrival), arrival);
  }
}

TEST(ControllerClock, APauseLongerThanItsMemoryBeginsAnew) {
  ControllerClock clock;
  clock.moment_of(5, at_s(1000));
  // Half a second late after a minute: nothing else is known.
  EXPECT_EQ(clock.moment_of(65, at_s(1060.5)), at_s(1060.5));
}

}  // namespace
}  // namespace orbwatch::app::machine
