// SPDX-License-Identifier: Apache-2.0
#include "app/machine/controller_clock.h"

#include <gtest/gtest.h>

#include <optional>
#include <random>

#include "tests/app/machine/moments.h"

namespace orbwatch::app::machine {
namespace {

using tests::at_s;

using Double = std::chrono::duration<double>;

/// Worst error of the moments, s, of messages every 20 ms that are up to `jitter` late, after the
/// first `settling` seconds; `clock` is the controller's for a moment of ours.
template <class Clock>
double worst_error(ControllerClock& tested, double begin, double end, double jitter, Clock clock,
                   double settling = 1) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> late(0, jitter);
  double worst = 0, newest = 0;
  for (double t = begin; t < end; t += 0.02) {
    newest = std::max(newest, t + late(random));  // messages keep their order
    const double error = Double(tested.moment_of(clock(t), at_s(newest)).value() - at_s(t)).count();
    if (t > begin + settling) worst = std::max(worst, std::abs(error));
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

TEST(ControllerClock, AClockThatIsSetBackALittleIsFollowedAfterTwoSeconds) {
  for (const double step : {-0.3, -0.8}) {
    for (const double begin : {1010.05, 1010.3, 1010.5, 1010.9}) {
      ControllerClock clock;
      worst_error(clock, 1000, begin, 0.01, [](double t) { return t; });
      const auto set = [step](double t) { return t + step; };
      EXPECT_LT(worst_error(clock, begin, begin + 10, 0.01, set, 2), 0.003)
          << step << " s at " << begin;
    }
  }
}

TEST(ControllerClock, AfterAStallOfTheNetworkOnePromptMessageIsEnough) {
  ControllerClock clock;
  worst_error(clock, 1000, 1010, 0.01, [](double t) { return t; });
  for (double t = 1010; t < 1013; t += 0.02) clock.moment_of(t, at_s(t + 0.2));
  clock.moment_of(1013.5, at_s(1013.5));
  const hal::TimePoint late = clock.moment_of(1013.52, at_s(1013.72)).value();
  EXPECT_NEAR(Double(late - at_s(1013.52)).count(), 0, 1e-6);
}

TEST(ControllerClock, NoMomentIsLaterThanItsArrival) {
  ControllerClock clock;
  std::mt19937 random(11);
  std::uniform_real_distribution<double> any(0, 4e9);
  for (int n = 0; n < 1000; ++n) {
    const hal::TimePoint arrival = at_s(1000 + n * 0.01);
    EXPECT_LE(clock.moment_of(any(random), arrival).value(), arrival);
  }
}

TEST(ControllerClock, APauseLongerThanItsMemoryBeginsAnew) {
  ControllerClock clock;
  clock.moment_of(5, at_s(1000));
  // Half a second late after a minute: nothing else is known.
  EXPECT_EQ(clock.moment_of(65, at_s(1060.5)), at_s(1060.5));
}

TEST(ControllerClock, OfMessagesWithOneClockTheFirstHasItsMoment) {
  ControllerClock clock;
  EXPECT_EQ(clock.moment_of(5, at_s(1000)), at_s(1000));
  EXPECT_FALSE(clock.moment_of(5, at_s(1000.004)));
  EXPECT_FALSE(clock.moment_of(5, at_s(1000.04))) << "late";
  EXPECT_NEAR(Double(clock.moment_of(5.01, at_s(1000.041)).value() - at_s(1000.01)).count(), 0,
              1e-6);
  EXPECT_FALSE(clock.stands(at_s(1000.041)));
}

TEST(ControllerClock, OneThatStoodIsUsedAgainAfterItRan) {
  ControllerClock clock;
  worst_error(clock, 1000, 1001.9, 0.01, [](double t) { return t; });
  EXPECT_TRUE(clock.moment_of(1002, at_s(1002)));
  for (double t = 1002.02; t < 1003; t += 0.02) {
    const bool stands = t > 1002.05;
    const std::optional<hal::TimePoint> moment = clock.moment_of(1002, at_s(t));
    EXPECT_EQ(moment.has_value(), stands) << t;
    EXPECT_EQ(moment.value_or(at_s(t)), at_s(t));
    EXPECT_EQ(clock.stands(at_s(t)), stands) << t;
  }
  const auto runs = [](double t) { return t - 1; };
  EXPECT_GT(worst_error(clock, 1003, 1010, 0.01, runs), 0.005) << "by arrival";
  EXPECT_LT(worst_error(clock, 1012, 1022, 0.01, runs), 0.003);
}

}  // namespace
}  // namespace orbwatch::app::machine
