// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <random>
#include <thread>
#include <vector>

#include "tests/app/pipeline/measured_pipeline_case.h"

/// Measurement, its commands and notices, and what operators change in views meanwhile.
namespace orbwatch::app::pipeline {
namespace {

using hal::Clock;
using std::chrono::seconds;

TEST_F(MeasuredPipeline, StoppedIsAStateAndCamerasAndViewsGoOn) {
  start({plan(1)});
  EXPECT_EQ(next_frame().state, SystemState::Running);
  ASSERT_EQ(pipeline->stop_measuring(), CommandResult::Done);
  sink.wait_for([](const Status& status) { return status.state == SystemState::Stopped; });
  const Status stopped = next_frame();
  EXPECT_EQ(stopped.state, SystemState::Stopped);
  EXPECT_EQ(stopped.regions[0].quality, Quality::NotMeasured);
  EXPECT_FALSE(stopped.process_active);
  EXPECT_EQ(stopped.cameras[0].frames, 2U);
  const Status later =
      sink.wait_for([](const Status& status) { return status.views[kSeen].published == 2; });
  EXPECT_EQ(later.views[1].published, 2U);
  ASSERT_EQ(pipeline->start_measuring(), CommandResult::Done);
  const Status running = next_frame();
  EXPECT_EQ(running.state, SystemState::Running);
  EXPECT_EQ(running.regions[0].quality, Quality::Apparent);
}

TEST_F(MeasuredPipeline, StartStopAndStateBelongTogetherInEveryStatus) {
  std::uint64_t torn = 0, running = 0, stopped = 0;
  sink.on_status = [&](const Status& status) {
    const bool measured = status.regions[0].quality != Quality::NotMeasured;
    if (status.frame_set == 0) return;
    const bool is_stopped = status.state == SystemState::Stopped;
    // From a start on it runs without a measurement until a frame arrives.
    torn += measured && (is_stopped || !status.process_active) ? 1U : 0U;
    torn += is_stopped && status.process_active ? 1U : 0U;
    ++(measured ? running : stopped);
  };
  start({plan(1)});
  {
    const std::jthread commanding([this](const std::stop_token& stop) {
      for (int n = 0; !stop.stop_requested(); ++n) {
        n % 2 == 0 ? pipeline->stop_measuring() : pipeline->start_measuring();
        std::this_thread::sleep_for(std::chrono::microseconds(n % 7 * 100));  // pace of an operator
      }
    });
    for (int n = 0; n < 100; ++n) next_frame();
  }
  pipeline->stop();
  EXPECT_EQ(torn, 0U);
  EXPECT_GE(running + stopped, 100U);
}

TEST_F(MeasuredPipeline, EveryTriggeredFrameIsAResultThatASinkSeesOnce) {
  std::vector<std::uint64_t> results;
  std::uint64_t last = 0;
  sink.on_status = [&](const Status& status) {
    if (status.result == last) return;
    last = status.result;
    results.push_back(status.result);
  };
  start({plan(1)});
  std::uint64_t granted = 0;
  for (int n = 0; n < 60; ++n) {
    if (n % 3 == 0) granted += pipeline->trigger() == CommandResult::Done ? 1U : 0U;
    next_frame();
  }
  pipeline->stop();
  EXPECT_EQ(granted, 20U);
  ASSERT_EQ(results.size(), granted);
  for (std::uint64_t n = 0; n < granted; ++n) EXPECT_EQ(results[n], n + 1);
}

TEST_F(MeasuredPipeline, NoticesComeOnceAndInOrderBeforeTheStatusThatShowsThem) {
  RecipePlan watched = plan(1);
  signals::AlarmLimits
      limits;  // for kSignals[0], regardless of its meaning: only the present spot counts
  limits.high_alarm = 0.5;
  limits.loss_delay.reset();
  watched.alarms = {limits};
  std::vector<AlarmNotice> notices;
  std::uint64_t early = 0;
  sink.on_notice = [&](const AlarmNotice& notice) { notices.push_back(notice); };
  sink.on_status = [&](const Status& status) {
    if (status.alarms[0].alarm.state == signals::AlarmState::Unacknowledged && notices.empty()) {
      ++early;
    }
  };
  start({watched});
  EXPECT_EQ(next_frame().alarms[0].alarm.state, signals::AlarmState::Unacknowledged);
  EXPECT_EQ(pipeline->acknowledge_alarm(2), CommandResult::ArgumentOutOfRange);
  ASSERT_EQ(pipeline->acknowledge_alarm(1), CommandResult::Done);
  sink.wait_for([](const Status& status) {
    return status.alarms[0].alarm.state == signals::AlarmState::Acknowledged;
  });
  ASSERT_EQ(pipeline->stop_measuring(), CommandResult::Done);
  sink.wait_for([](const Status& status) { return status.state == SystemState::Stopped; });
  pipeline->stop();
  EXPECT_EQ(early, 0U);
  ASSERT_EQ(notices.size(), 3U);
  EXPECT_EQ(notices[0].event.kind, signals::AlarmEventKind::Raised);
  EXPECT_EQ(notices[1].event.kind, signals::AlarmEventKind::Acknowledged);
  EXPECT_EQ(notices[2].event.kind, signals::AlarmEventKind::Suppressed);
  for (std::size_t n = 0; n < notices.size(); ++n) EXPECT_EQ(notices[n].number, n + 1);
}

TEST_F(MeasuredPipeline, OnlyDisplayViewsArePointedAndMixed) {
  start({plan(1), plan(2)});
  EXPECT_EQ(pipeline->point_view(kSeen, 20, -10, 80), CommandResult::Done);
  EXPECT_EQ(pipeline->point_view(kSeen, 20, -10, 0), CommandResult::Done);
  EXPECT_EQ(pipeline->point_view(kSeen, 0, 0, 180), CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(pipeline->mix_sources(kSeen, 0, 2.5), CommandResult::Done);
  EXPECT_EQ(pipeline->mix_sources(kSeen, 1, 2.5), CommandResult::ArgumentOutOfRange);
  for (const std::size_t measured : {1, 2}) {
    EXPECT_EQ(pipeline->point_view(measured, 20, 0, 0), CommandResult::NotPossible);
    EXPECT_EQ(pipeline->mix_sources(measured, 0, 2), CommandResult::NotPossible);
    EXPECT_EQ(pipeline->select_view(measured), CommandResult::Done);
  }
  EXPECT_EQ(pipeline->point_view(3, 0, 0, 0), CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(pipeline->mix_sources(3, 0, 1), CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(pipeline->select_view(3), CommandResult::ArgumentOutOfRange);
}

TEST_F(MeasuredPipeline, WhatOperatorsPointNeverChangesAMeasurement) {
  UntouchedVector<std::uint8_t> bytes;
  UntouchedVector<std::uint16_t> words;
  std::uint64_t measured = 0, changed = 0, moved = 0, pointings = 0;
  double yaw = 0;
  sink.on_view = [&](const View& view) {
    if (view.index == kSeen) {
      pointings = view.pointing;
      return;
    }
    if (measured++ == 0) {
      bytes = view.bytes;
      words = view.words;
    }
    changed += view.bytes == bytes && view.words == words ? 0U : 1U;
  };
  sink.on_status = [&](const Status& status) {
    if (status.frame_set == 0) return;
    const signals::Signals& signals = status.regions[0].signals;
    if (status.frame_set == 1) yaw = signals.hot_spot_yaw;
    moved += signals.hot_spot_yaw == yaw ? 0U : 1U;
    moved += std::abs(signals.hot_spot_peak_temperature - celsius(1)) < 0.1 ? 0U : 1U;
  };
  start({plan(1)});
  std::mt19937 random(9);
  std::uniform_real_distribution<double> angle(-80, 80), fov(20, 150), weight(0.1, 10);
  for (int n = 0; n < 150; ++n) {
    ASSERT_EQ(pipeline->point_view(kSeen, angle(random), angle(random), fov(random)),
              CommandResult::Done);
    ASSERT_EQ(pipeline->mix_sources(kSeen, 0, weight(random)), CommandResult::Done);
    next_frame();
  }
  const auto end = Clock::now() + seconds(30);
  while (pointings == 0 && Clock::now() < end) next_frame();
  pipeline->stop();
  EXPECT_GT(pointings, 0U) << "the other view was pointed indeed";
  EXPECT_EQ(measured, frames);
  EXPECT_EQ(changed, 0U);
  EXPECT_EQ(moved, 0U);
}

TEST_F(MeasuredPipeline, OtherColoursOfAMeasuredViewLeaveWhatItMeasures) {
  UntouchedVector<std::uint16_t> words;
  std::map<double, std::vector<std::uint8_t>>
      shown;  // pictures of the hot spot, by the end of the colours
  std::uint64_t changed = 0;
  sink.on_view = [&](const View& view) {
    if (view.index == kSeen) return;
    if (words.empty()) words = view.words;
    changed += view.words == words ? 0U : 1U;
    const auto spot = std::ranges::max_element(view.words) - view.words.begin();
    const int x = static_cast<int>(spot) % 96, y = static_cast<int>(spot) / 96;
    const std::uint8_t* const brightest = view.picture.samples<std::uint8_t>().at(x, y);
    shown[view.colours[0]->range[1]] = {brightest, brightest + 3};
  };
  start({plan(1)});
  const double peak = next_frame().regions[0].signals.hot_spot_peak_temperature;
  ASSERT_EQ(pipeline->set_colour_map(1, 0, 0), CommandResult::Done);
  ASSERT_EQ(pipeline->set_colour_range(1, 0, {-200, 50}), CommandResult::Done);
  next_frame();
  ASSERT_EQ(pipeline->set_colour_range(1, 0, {5000, 6000}), CommandResult::Done);
  EXPECT_EQ(next_frame().regions[0].signals.hot_spot_peak_temperature, peak);
  EXPECT_EQ(pipeline->set_colour_map(1, 0, 2), CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(pipeline->set_colour_map(1, 1, 0), CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(pipeline->set_colour_range(2, 0, {0, 1}), CommandResult::ArgumentOutOfRange);
  EXPECT_EQ(pipeline->set_colour_range(1, 0, {1, 1}), CommandResult::ArgumentOutOfRange);
  pipeline->stop();
  EXPECT_EQ(changed, 0U);
  ASSERT_EQ(shown.size(), 3U) << "each frame shows what was asked for before it";
  const std::vector<std::uint8_t> white{255, 255, 255}, black{0, 0, 0};
  EXPECT_EQ(shown[50], white);
  EXPECT_EQ(shown[6000], black);
}

TEST_F(MeasuredPipeline, WithoutARecipeNothingIsMeasured) {
  start({});
  const Status status = next_frame();
  EXPECT_EQ(status.state, SystemState::Running);
  EXPECT_EQ(status.recipe, 0);
  EXPECT_EQ(status.region_count, 0U);
  EXPECT_EQ(pipeline->start_measuring(), CommandResult::NotPossible);
  EXPECT_EQ(pipeline->stop_measuring(), CommandResult::NotPossible);
  EXPECT_EQ(pipeline->trigger(), CommandResult::NotPossible);
  EXPECT_EQ(pipeline->acknowledge_alarm(0), CommandResult::NotPossible);
  EXPECT_EQ(pipeline->set_process_active(false), CommandResult::NotPossible);
  EXPECT_EQ(pipeline->select_recipe(1), CommandResult::NotPossible);
}

}  // namespace
}  // namespace orbwatch::app::pipeline
