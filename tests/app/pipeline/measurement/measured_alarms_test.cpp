// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <vector>

#include "tests/app/pipeline/measurement/measurement_bench.h"

namespace orbwatch::app::pipeline {
namespace {

using hal::Clock;
using hal::TimePoint;
using signals::AlarmEventKind;
using std::chrono::seconds;

using MeasuredAlarms = MeasurementTest;

/// Kinds of the notices since the last call.
std::vector<AlarmEventKind> kinds(std::vector<AlarmNotice>& notices, std::size_t& seen) {
  std::vector<AlarmEventKind> kinds;
  for (; seen < notices.size(); ++seen) kinds.push_back(notices[seen].event.kind);
  return kinds;
}

TEST_F(MeasuredAlarms, RaisesSuppressesAndAcknowledgesAlarms) {
  using Kinds = std::vector<AlarmEventKind>;
  RecipePlan watched = plan(1);
  watched.process_active = ActiveSource::Command;
  watched.alarms = {hotter_than(celsius(1) + 10), hotter_than(celsius(1) - 10)};
  measure_by({watched});
  std::size_t seen = 0;
  Status status = expose();
  EXPECT_EQ(status.alarm_count, 2U);
  EXPECT_EQ(status.alarms[1].alarm.state, signals::AlarmState::SuppressedByDesign);
  EXPECT_NEAR(status.alarms[1].value, celsius(1), 0.1) << "its signal is reported all the same";
  EXPECT_EQ(kinds(notices, seen), Kinds{});

  measurement->set_process_active(true);
  status = expose();
  ASSERT_EQ(kinds(notices, seen), Kinds{AlarmEventKind::Raised});
  EXPECT_EQ(notices[0].event.alarm, 1U);
  EXPECT_EQ(notices[0].recipe, 1);
  EXPECT_EQ(notices[0].frame_set, sets);
  EXPECT_EQ(static_cast<std::size_t>(notices[0].signal), signal("hot_spot_peak_temperature"));
  EXPECT_EQ(status.alarms[0].alarm.state, signals::AlarmState::Normal);
  EXPECT_EQ(status.alarms[1].alarm.state, signals::AlarmState::Unacknowledged);

  EXPECT_EQ(measurement->acknowledge_alarm(3), CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(measurement->acknowledge_alarm(65535), CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(measurement->acknowledge_alarm(1), CommandResult::Done);
  expose();
  EXPECT_EQ(kinds(notices, seen), Kinds{}) << "the other one";
  EXPECT_EQ(notices[0].by.name(), "");
  EXPECT_EQ(measurement->acknowledge_alarm(2, Giver("anna")), CommandResult::Done);
  EXPECT_EQ(idle().alarms[1].alarm.state, signals::AlarmState::Acknowledged);
  EXPECT_EQ(notices.back().by.name(), "anna");
  EXPECT_EQ(kinds(notices, seen), Kinds{AlarmEventKind::Acknowledged}) << "needs no frame";

  measurement->set_process_active(false);
  expose();
  EXPECT_EQ(kinds(notices, seen), Kinds{AlarmEventKind::Suppressed});
  measurement->set_process_active(true);
  expose();
  EXPECT_EQ(kinds(notices, seen), Kinds{AlarmEventKind::Raised});
  EXPECT_EQ(measurement->acknowledge_alarm(0, Giver("over Modbus")), CommandResult::Done)
      << "0: all";
  expose();
  EXPECT_EQ(notices.back().by.name(), "over Modbus");
  EXPECT_EQ(kinds(notices, seen), Kinds{AlarmEventKind::Acknowledged});
  expose({}, Clock::now(), 31000);
  EXPECT_EQ(kinds(notices, seen), Kinds{AlarmEventKind::Cleared});
}

TEST_F(MeasuredAlarms, WhatStoodInARecipeThatIsLeftIsSuppressed) {
  RecipePlan first = plan(1), second = plan(2);
  first.alarms = {hotter_than(celsius(1) + 10), hotter_than(celsius(1) - 10)};
  second.alarms = {hotter_than(celsius(2) - 10), hotter_than(celsius(2) + 10)};
  measure_by({first, second});
  expose();
  ASSERT_EQ(notices.size(), 1U);
  ASSERT_EQ(measurement->acknowledge_alarm(1), CommandResult::Done);
  ASSERT_EQ(select(2), CommandResult::Done);
  const Status status = expose();
  ASSERT_EQ(notices.size(), 3U);
  EXPECT_EQ(notices[1].event.kind, AlarmEventKind::Suppressed);
  EXPECT_EQ(notices[1].recipe, 1);
  EXPECT_EQ(notices[1].event.alarm, 1U);
  EXPECT_EQ(notices[2].event.kind, AlarmEventKind::Raised);
  EXPECT_EQ(notices[2].recipe, 2);
  EXPECT_EQ(status.alarms[0].alarm.state, signals::AlarmState::Unacknowledged)
      << "the acknowledgement was for the recipe before";
  ASSERT_EQ(select(1), CommandResult::Done);
  expose();
  ASSERT_EQ(notices.size(), 5U);
  EXPECT_EQ(notices[4].event.kind, AlarmEventKind::Raised) << "starts from normal";
  EXPECT_EQ(notices[4].recipe, 1);
}

TEST_F(MeasuredAlarms, AlarmsContinueWhenTheirRecipeIsExchanged) {
  RecipePlan watched = plan(1);
  watched.alarms = {hotter_than(celsius(1) - 10)};
  watched.alarms[0].latching = true;
  measure_by({watched});
  constexpr std::uint16_t kCold = 31000;
  expose();
  const AlarmStatus before = expose({}, Clock::now(), kCold).alarms[0];
  ASSERT_EQ(before.alarm.state, signals::AlarmState::LatchedUnacknowledged);
  std::vector<std::unique_ptr<CompiledRecipe>> recipes;
  recipes.push_back(compiled(watched));
  measurement->exchange(recipes);
  for (const AlarmStatus& after : {idle().alarms[0], expose({}, Clock::now(), kCold).alarms[0]}) {
    EXPECT_EQ(after.alarm, before.alarm);
    EXPECT_EQ(after.since, before.since);
  }
  EXPECT_EQ(notices.size(), 2U) << "raised, and its cause cleared";
  ASSERT_EQ(measurement->acknowledge_alarm(1), CommandResult::Done);
  EXPECT_EQ(idle().alarms[0].alarm.state, signals::AlarmState::Normal);
}

TEST_F(MeasuredAlarms, ALostCameraRaisesTheLossOfADetectedProcess) {
  RecipePlan watched = plan(1);
  watched.process_active = ActiveSource::Detected;
  watched.alarms = {hotter_than(celsius(1) + 10)};
  watched.alarms[0].loss_delay = std::chrono::nanoseconds(0);
  measure_by({watched});
  for (const std::uint16_t bright : {kBright, std::uint16_t{20000}}) {
    const bool is_active = bright == kBright;
    ASSERT_EQ(expose({}, Clock::now(), bright).process_active, is_active);
    const Status lost = idle(true);
    EXPECT_TRUE(lost.alarms[0].alarm.measurement_lost);
    EXPECT_EQ(lost.alarms[0].alarm.state, signals::AlarmState::Unacknowledged);
    EXPECT_EQ(lost.process_active, is_active) << "as it was known last";
  }
}

TEST_F(MeasuredAlarms, AnAlarmWhoseHotSpotIsGoneBecomesItsLoss) {
  RecipePlan watched = plan(1);
  watched.process_active = ActiveSource::Always;
  watched.alarms = {hotter_than(celsius(1) - 10)};
  watched.alarms[0].loss_delay = std::chrono::nanoseconds(0);
  measure_by({watched});
  ASSERT_EQ(expose().alarms[0].alarm.level, signals::AlarmLevel::HighAlarm);
  ASSERT_EQ(measurement->acknowledge_alarm(1), CommandResult::Done);
  constexpr std::uint16_t kCold = 20000;
  const signals::Alarm lost = expose({}, Clock::now(), kCold).alarms[0].alarm;
  EXPECT_EQ(lost,
            (signals::Alarm{signals::AlarmState::Unacknowledged, signals::AlarmLevel::NoMeasurement,
                            signals::AlarmLevel::HighAlarm, true}));
  EXPECT_EQ(notices.back().event.kind, AlarmEventKind::Raised);
  ASSERT_EQ(measurement->acknowledge_alarm(1), CommandResult::Done);
  EXPECT_EQ(expose({}, Clock::now(), kCold).alarms[0].alarm.announced,
            signals::AlarmLevel::NoMeasurement);
  EXPECT_EQ(expose({}, Clock::now(), 31000).alarms[0].alarm, signals::Alarm{});
}

TEST_F(MeasuredAlarms, ANoticeBeforeTheFirstSetHasATimeStamp) {
  RecipePlan watched = plan(1);
  watched.alarms = {hotter_than(1000)};
  watched.alarms[0].loss_delay = std::chrono::nanoseconds(0);
  measure_by({watched});
  const TimePoint begin = Clock::now();
  const auto end = begin + seconds(30);
  while (notices.empty() && Clock::now() < end) idle();
  ASSERT_FALSE(notices.empty());
  EXPECT_EQ(notices[0].frame_set, 0U);
  EXPECT_GE(notices[0].stamp, begin);
  EXPECT_EQ(notices[0].event.level, signals::AlarmLevel::NoMeasurement);
}

}  // namespace
}  // namespace orbwatch::app::pipeline
