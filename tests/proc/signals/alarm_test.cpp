// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/alarm.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "tests/proc/signals/alarm_clock.h"

namespace orbwatch::signals {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;
using tests::AlarmClock;
using tests::kNoValue;
using Level = AlarmLevel;
using State = AlarmState;

/// Limits -20, -10, 10 and 20, hysteresis 2; on after 2 s, off after 3 s, lost after 5 s.
AlarmLimits both_sides() {
  AlarmLimits limits;
  limits.low_alarm = -20;
  limits.low_warning = -10;
  limits.high_warning = 10;
  limits.high_alarm = 20;
  limits.hysteresis = 2;
  limits.on_delay = seconds(2);
  limits.off_delay = seconds(3);
  limits.loss_delay = seconds(5);
  return limits;
}

AlarmLimits without_delays() {
  AlarmLimits limits = both_sides();
  limits.on_delay = limits.off_delay = nanoseconds(0);
  return limits;
}

/// Applies `value` for `time`, stepped ten times a second.
const Alarm& keep(AlarmClock& clock, nanoseconds time, double value) {
  for (nanoseconds passed{0}; passed < time; passed += milliseconds(100)) {
    clock.after(milliseconds(100), value);
  }
  return clock.alarm();
}

TEST(AlarmLimit, IsReachedAtItsValueAndLeftBeyondTheHysteresis) {
  AlarmClock clock(without_delays());
  const auto level = [&](double value) { return clock.after(milliseconds(100), value).level; };
  EXPECT_EQ(level(9.999), Level::None);
  EXPECT_EQ(level(10), Level::HighWarning);
  EXPECT_EQ(level(20), Level::HighAlarm);
  EXPECT_EQ(level(18), Level::HighAlarm);
  EXPECT_EQ(level(17.999), Level::HighWarning);
  EXPECT_EQ(level(8), Level::HighWarning);
  EXPECT_EQ(level(7.999), Level::None);
  EXPECT_EQ(level(-10), Level::LowWarning);
  EXPECT_EQ(level(-20), Level::LowAlarm);
  EXPECT_EQ(level(-18), Level::LowAlarm);
  EXPECT_EQ(level(-17.999), Level::LowWarning);
  EXPECT_EQ(level(-8), Level::LowWarning);
  EXPECT_EQ(level(-7.999), Level::None);
}

TEST(AlarmLimit, AloneDoes) {
  AlarmLimits limits;
  limits.low_alarm = 5;
  AlarmClock clock(limits);
  EXPECT_EQ(clock.after(milliseconds(1), 1e300).level, Level::None);
  EXPECT_EQ(clock.after(milliseconds(1), 5).level, Level::LowAlarm);
}

TEST(AlarmDelay, CountsFromTheFirstMeasurementThatReachesTheLimit) {
  AlarmClock clock(both_sides());
  clock.after(milliseconds(100), 0);
  clock.after(milliseconds(900), 15);
  EXPECT_EQ(clock.after(milliseconds(1000), 15).level, Level::None);
  EXPECT_EQ(clock.after(milliseconds(999), 15).level, Level::None);
  EXPECT_EQ(clock.after(milliseconds(1), 15).level, Level::HighWarning);
}

TEST(AlarmDelay, StartsAnewWhenTheConditionPauses) {
  AlarmClock clock(both_sides());
  keep(clock, milliseconds(1900), 15);
  clock.after(milliseconds(100), 9);
  EXPECT_EQ(keep(clock, milliseconds(2000), 15).level, Level::None);
  EXPECT_EQ(clock.after(milliseconds(100), 15).level, Level::HighWarning);
  keep(clock, milliseconds(2900), 0);
  clock.after(milliseconds(100), 8);  // within the hysteresis: not back
  EXPECT_EQ(keep(clock, milliseconds(3000), 0).level, Level::HighWarning);
  EXPECT_EQ(clock.after(milliseconds(100), 0).level, Level::None);
}

TEST(AlarmDelay, EachLimitCountsForItself) {
  AlarmClock clock(both_sides());
  keep(clock, milliseconds(1100), 15);
  EXPECT_EQ(keep(clock, milliseconds(1000), 25).level, Level::HighWarning);
  EXPECT_EQ(keep(clock, milliseconds(1100), 25).level, Level::HighAlarm);
}

TEST(AlarmDelay, ALongGapCountsAsTheLongestStep) {
  AlarmClock clock(both_sides());
  clock.after(milliseconds(1), 15);
  EXPECT_EQ(clock.after(std::chrono::hours(1000), 15).level, Level::None);
  EXPECT_EQ(clock.after(milliseconds(999), 15).level, Level::None);
  EXPECT_EQ(clock.after(milliseconds(1), 15).level, Level::HighWarning);
}

TEST(AlarmDelay, StandsStillWhileTheValueIsNotNew) {
  AlarmClock clock(both_sides());
  clock.after(seconds(0), 10);
  for (int n = 0; n < 100; ++n) clock.after(milliseconds(100), 10, false);
  EXPECT_EQ(clock.level(), Level::None);
  clock.after(milliseconds(100), 10);
  EXPECT_EQ(clock.level(), Level::None) << "a gap counts as the longest step";
  clock.after(seconds(1), 10);
  EXPECT_EQ(clock.level(), Level::HighWarning);
  for (int n = 0; n < 100; ++n) clock.after(milliseconds(100), 10, false);
  EXPECT_FALSE(clock.alarm().measurement_lost) << "none was due";
  clock.after(seconds(1), kNoValue, false);
  for (int n = 0; n < 5; ++n) clock.after(seconds(1), kNoValue, false);
  EXPECT_TRUE(clock.alarm().measurement_lost);
}

TEST(AlarmDelay, TimeThatGoesBackCountsNothingAndGoesOnFromThere) {
  AlarmClock clock(both_sides());
  keep(clock, milliseconds(1100), 15);
  clock.after(-std::chrono::hours(3), 15);
  EXPECT_EQ(keep(clock, milliseconds(900), 15).level, Level::None);
  EXPECT_EQ(clock.after(milliseconds(100), 15).level, Level::HighWarning);
}

TEST(AlarmSides, WhatBeginsOnOneEndsWhatTheOffDelayHoldsOnTheOther) {
  AlarmClock clock(both_sides());
  EXPECT_EQ(keep(clock, milliseconds(2100), 25).level, Level::HighAlarm);
  clock.acknowledge();
  EXPECT_EQ(keep(clock, milliseconds(2000), -15).level, Level::HighAlarm);
  const Alarm& alarm = clock.after(milliseconds(100), -15);
  EXPECT_EQ(alarm.level, Level::LowWarning);
  EXPECT_EQ(alarm.state, State::Unacknowledged) << "the other side was not seen yet";
}

TEST(AlarmRise, FromWarningToAlarmNeedsANewAcknowledgement) {
  AlarmClock clock(without_delays());
  clock.after(milliseconds(100), 12);
  clock.acknowledge();
  EXPECT_EQ(clock.after(milliseconds(100), 25).state, State::Unacknowledged);
  clock.acknowledge();
  EXPECT_EQ(clock.after(milliseconds(100), 12).state, State::Acknowledged) << "it only eased";
  EXPECT_EQ(clock.alarm().announced, Level::HighWarning);
}

TEST(AlarmRise, TheWorstLevelStaysAnnouncedUntilItIsAcknowledged) {
  AlarmClock clock(without_delays());
  clock.after(milliseconds(100), 25);
  EXPECT_EQ(clock.after(milliseconds(100), 12).level, Level::HighWarning);
  EXPECT_EQ(clock.alarm().announced, Level::HighAlarm);
  clock.after(milliseconds(100), 0);
  EXPECT_EQ(clock.after(milliseconds(100), -12).announced, Level::HighAlarm);
  EXPECT_EQ(clock.acknowledge().announced, Level::LowWarning);
}

TEST(AlarmLatch, KeepsTheWorstLevelUntilItIsReset) {
  AlarmLimits limits = without_delays();
  limits.latching = true;
  AlarmClock clock(limits);
  clock.after(milliseconds(100), 25);
  clock.acknowledge();
  clock.after(milliseconds(100), 12);
  EXPECT_EQ(clock.alarm().announced, Level::HighAlarm);
  clock.after(milliseconds(100), 0);
  EXPECT_EQ(clock.alarm(), (Alarm{State::LatchedAcknowledged, Level::None, Level::HighAlarm}));
  EXPECT_EQ(clock.acknowledge(), Alarm{});
}

TEST(AlarmRise, WhatWasAcknowledgedIsNotAnnouncedAgain) {
  AlarmClock clock(without_delays());
  clock.after(milliseconds(100), 25);
  clock.acknowledge();
  EXPECT_EQ(clock.after(milliseconds(100), -12),
            (Alarm{State::Unacknowledged, Level::LowWarning, Level::LowWarning}));
}

class NoMeasurement : public testing::TestWithParam<double> {};

TEST_P(NoMeasurement, ClearsNothing) {
  AlarmLimits limits = both_sides();
  limits.loss_delay.reset();
  AlarmClock clock(limits);
  keep(clock, milliseconds(2100), 25);
  const Alarm before = clock.alarm();
  EXPECT_EQ(keep(clock, seconds(600), GetParam()), before);
}

TEST_P(NoMeasurement, RaisesNoLimit) {
  AlarmLimits limits = both_sides();
  limits.loss_delay.reset();
  AlarmClock clock(limits);
  keep(clock, milliseconds(1900), 25);
  EXPECT_EQ(keep(clock, seconds(600), GetParam()), Alarm{});
}

TEST_P(NoMeasurement, StopsTheDelaysButDoesNotRestartThem) {
  AlarmClock clock(both_sides());
  clock.after(milliseconds(100), 15);
  keep(clock, milliseconds(1000), 15);
  keep(clock, milliseconds(4000), GetParam());
  EXPECT_EQ(clock.after(milliseconds(100), 15).level, Level::None) << "the way back counts neither";
  EXPECT_EQ(keep(clock, milliseconds(900), 15).level, Level::None);
  EXPECT_EQ(clock.after(milliseconds(100), 15).level, Level::HighWarning);
}

TEST_P(NoMeasurement, IsRaisedAfterItsDelayAndEndsAfterTheOffDelay) {
  AlarmClock clock(both_sides());
  clock.after(milliseconds(100), 0);
  EXPECT_EQ(keep(clock, milliseconds(5000), GetParam()), Alarm{});
  clock.after(milliseconds(100), GetParam());
  EXPECT_EQ(clock.alarm(),
            (Alarm{State::Unacknowledged, Level::NoMeasurement, Level::NoMeasurement, true}));
  clock.acknowledge();
  clock.after(milliseconds(100), 0);
  EXPECT_EQ(keep(clock, milliseconds(2900), 0).state, State::Acknowledged);
  EXPECT_EQ(clock.after(milliseconds(100), 0), Alarm{});
}

TEST_P(NoMeasurement, TakesThePlaceOfTheAlarmThatStoodAndCalmsNothing) {
  AlarmClock clock(both_sides());
  keep(clock, milliseconds(2100), 25);
  clock.acknowledge();
  const Alarm standing = clock.alarm();
  EXPECT_EQ(keep(clock, milliseconds(5000), GetParam()), standing) << "the delay counts";
  clock.after(milliseconds(100), GetParam());
  EXPECT_EQ(clock.alarm(),
            (Alarm{State::Unacknowledged, Level::NoMeasurement, Level::HighAlarm, true}));
  EXPECT_EQ(clock.acknowledge(),
            (Alarm{State::Acknowledged, Level::NoMeasurement, Level::NoMeasurement, true}));
  keep(clock, milliseconds(3000), 0);
  EXPECT_EQ(clock.level(), Level::NoMeasurement);
  EXPECT_EQ(clock.after(milliseconds(100), 0), Alarm{});
}

TEST_P(NoMeasurement, EndsWhenALimitIsReachedAgain) {
  AlarmClock clock(both_sides());
  keep(clock, milliseconds(2100), 25);
  keep(clock, milliseconds(5100), GetParam());
  clock.acknowledge();
  EXPECT_EQ(keep(clock, milliseconds(2000), 25).level, Level::NoMeasurement);
  EXPECT_EQ(clock.after(milliseconds(100), 25),
            (Alarm{State::Unacknowledged, Level::HighAlarm, Level::HighAlarm}));
  EXPECT_EQ(keep(clock, milliseconds(5000), GetParam()).level, Level::HighAlarm)
      << "the next loss has a delay of its own";
  EXPECT_EQ(clock.after(milliseconds(100), GetParam()).level, Level::NoMeasurement);
}

TEST_P(NoMeasurement, ThatComesAndGoesNeverClearsALostAlarm) {
  AlarmClock clock(both_sides());
  keep(clock, milliseconds(2100), 25);
  keep(clock, milliseconds(5100), GetParam());
  for (int i = 0; i < 20; ++i) {
    keep(clock, milliseconds(2900), 0);
    keep(clock, milliseconds(200), GetParam());
    ASSERT_EQ(clock.alarm(),
              (Alarm{State::Unacknowledged, Level::NoMeasurement, Level::HighAlarm, true}))
        << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Alarm, NoMeasurement,
                         testing::Values(kNoValue, std::numeric_limits<double>::infinity(),
                                         -std::numeric_limits<double>::infinity()));

TEST(AlarmSuppression, ClearsWhatStandsAndRestartsTheDelays) {
  AlarmClock clock(both_sides());
  keep(clock, milliseconds(2100), 25);
  clock.set_active(false);
  EXPECT_EQ(keep(clock, seconds(60), 25), (Alarm{State::SuppressedByDesign}));
  clock.set_active(true);
  clock.after(milliseconds(100), 25);
  EXPECT_EQ(clock.state(), State::Normal);
  EXPECT_EQ(keep(clock, milliseconds(1900), 25).state, State::Normal);
  EXPECT_EQ(clock.after(milliseconds(100), 25).state, State::Unacknowledged);
}

TEST(AlarmSuppression, NeedsNoMeasurement) {
  AlarmClock clock(both_sides());
  clock.set_active(false);
  keep(clock, seconds(60), kNoValue);
  EXPECT_EQ(clock.alarm(), (Alarm{State::SuppressedByDesign}));
  clock.set_active(true);
  EXPECT_EQ(keep(clock, milliseconds(5000), kNoValue), Alarm{});
  EXPECT_EQ(clock.after(milliseconds(100), kNoValue).level, Level::NoMeasurement);
}

TEST(AlarmSuppression, LeavesWhatIsLatchedUntilItIsAcknowledged) {
  AlarmLimits limits = without_delays();
  limits.latching = true;
  AlarmClock clock(limits);
  clock.after(milliseconds(100), 25);
  clock.set_active(false);
  keep(clock, seconds(60), 0);
  EXPECT_EQ(clock.alarm(), (Alarm{State::LatchedUnacknowledged, Level::None, Level::HighAlarm}));
  clock.acknowledge();
  EXPECT_EQ(clock.after(milliseconds(100), 0), (Alarm{State::SuppressedByDesign}));
}

TEST(AlarmSuppression, IsNotForAlarmsThatAlwaysCount) {
  AlarmLimits limits = without_delays();
  limits.only_while_active = false;
  AlarmClock clock(limits);
  clock.set_active(false);
  EXPECT_EQ(clock.after(milliseconds(100), 25).level, Level::HighAlarm);
}

/// A slow swing with noise below the hysteresis: one alarm per swing, however often it is sampled.
TEST(AlarmHysteresis, DoesNotChatter) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> noise(-0.99, 0.99);
  AlarmClock clock(without_delays());
  int raised = 0;
  int cleared = 0;
  constexpr int kSwings = 50;
  constexpr int kSamples = 2000;
  for (int i = 0; i < kSwings * kSamples; ++i) {
    const Alarm before = clock.alarm();
    const double phase = 2 * std::numbers::pi * i / kSamples;
    const Alarm& after = clock.after(milliseconds(10), 7.5 - 7.5 * std::cos(phase) + noise(random));
    raised += is_raised(before, after) ? 1 : 0;
    cleared += before.level != Level::None && after.level == Level::None ? 1 : 0;
  }
  EXPECT_EQ(raised, kSwings);
  EXPECT_EQ(cleared, kSwings);
}

}  // namespace
}  // namespace orbwatch::signals
