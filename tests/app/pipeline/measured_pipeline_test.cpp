// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <map>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

#include "app/pictures/colour_maps.h"
#include "app/pipeline/pipeline.h"
#include "tests/app/pipeline/hand_camera.h"
#include "tests/app/pipeline/measurement/measured_recipe.h"
#include "tests/app/pipeline/views/thermal_view.h"

namespace orbwatch::app::pipeline {
namespace {

using hal::Clock;
using std::chrono::seconds;

/// Camera whose settable exposure time is the brightness of its pictures. Like with a sensor, some
/// exposures after a setting still have the previous one.
class SettableCamera : public HandCamera {
 public:
  explicit SettableCamera(std::size_t delay)
      : HandCamera("thermal", PixelFormat::Y16), delay_(delay) {}

  /// Applies settings at once, like at a camera's start.
  void take_on() {
    const std::lock_guard lock(mutex_);
    waiting_ = 0;
  }
  /// Delivers a frame whose exposure begins now.
  void expose_as_set() {
    std::uint16_t bright = 0;
    hal::TimePoint moment;
    {
      const std::lock_guard lock(mutex_);
      if (waiting_ == 0) exposure_ = set_;
      waiting_ -= waiting_ > 0 ? 1 : 0;
      bright = exposure_;
      moment = Clock::now();
    }
    expose(bright, moment);
  }

 private:
  Result<> do_set(std::string_view control, double value) override {
    if (control != "ExposureTime") return Camera::do_set(control, value);
    std::this_thread::sleep_for(std::chrono::microseconds(200));  // delay of its driver
    const std::lock_guard lock(mutex_);
    set_ = static_cast<std::uint16_t>(value);
    waiting_ = delay_;
    return {};
  }
  std::size_t control_delay() const override { return delay_; }

  const std::size_t delay_;
  std::mutex mutex_;
  std::uint16_t set_ = 0;
  std::uint16_t exposure_ = 0;
  std::size_t waiting_ = 0;  ///< exposures that do not have the new setting yet
};

constexpr std::size_t kSeen = 0;  ///< the display view; those of recipes come after it

/// Calls the examining function, one call at a time; the test waits for an expected status.
class ExaminingSink : public Sink {
 public:
  Result<> start() override { return {}; }
  void stop() override {}
  PictureNeeds needs(std::size_t, hal::TimePoint) override { return need_of(PixelFormat::Rgb); }
  void accept(const ViewPtr& view) override {
    const std::lock_guard lock(mutex_);
    if (on_view) on_view(*view);
    if (view->index == kSeen) seen_set_ = view->frame_set;
    changed_.notify_all();
  }
  void accept(const Status& status) override {
    const std::lock_guard lock(mutex_);
    if (on_status) on_status(status);
    status_ = status;
    changed_.notify_all();
  }
  void accept_event(const AlarmNotice& notice) override {
    const std::lock_guard lock(mutex_);
    if (on_notice) on_notice(notice);
  }
  template <class Condition>
  Status wait_for(Condition condition) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, seconds(30), [&] { return condition(status_); }));
    return status_;
  }
  /// Waits for the display view of a set, which comes last.
  void wait_for_pictures(std::uint64_t set) {
    std::unique_lock lock(mutex_);
    EXPECT_TRUE(changed_.wait_for(lock, seconds(30), [&] { return seen_set_ == set; }));
  }

  // Set before the pipeline starts.
  std::function<void(const View&)> on_view;
  std::function<void(const Status&)> on_status;
  std::function<void(const AlarmNotice&)> on_notice;

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  Status status_;
  std::uint64_t seen_set_ = 0;
};

constexpr std::uint32_t kChecksum = 0xC0FFEE01;

class MeasuredPipeline : public testing::Test {
 protected:
  /// Scale and exposure of each recipe.
  static double scale(std::uint16_t recipe) { return 0.05 - 0.01 * recipe; }
  static double exposure(std::uint16_t recipe) { return 31000 + 5000 * recipe; }
  static double celsius(std::uint16_t recipe) { return exposure(recipe) * scale(recipe) - 273.15; }

  static RecipePlan plan(std::uint16_t number) {
    return recipe_plan(thermal_view(number, "measured_" + std::to_string(number)), 30000,
                       scale(number), number);
  }
  static RecipePlan plan_with_exposure(std::uint16_t number) {
    RecipePlan measured = plan(number);
    measured.controls.push_back({{"camera", 0}, "ExposureTime", exposure(number)});
    return measured;
  }

  void start(std::vector<RecipePlan> recipes, std::size_t control_delay = 0) {
    PipelinePlan plan;
    auto hand = std::make_unique<SettableCamera>(control_delay);
    plan.formats.push_back(hand->configure({}).value());
    camera = hand.get();
    EXPECT_TRUE(camera->set("ExposureTime", exposure(1)));
    camera->take_on();
    plan.cameras.push_back(std::move(hand));
    plan.deadline = seconds(20);
    plan.workers = 1;
    plan.configuration_checksum = kChecksum;
    plan.views.push_back(thermal_view(kSeen, "seen"));
    plan.view_count = 1 + recipes.size();
    plan.colour_maps = {colour_map_table("grey"), colour_map_table("hot")};
    for (RecipePlan& recipe : recipes) plan.recipes.push_back(compiled(std::move(recipe)));
    pipeline.emplace(std::move(plan));
    ASSERT_TRUE(pipeline->start({&sink}));
  }
  /// Status of the next frame, whose pictures have come, too.
  Status next_frame() {
    camera->expose_as_set();
    const Status measured =
        sink.wait_for([n = ++frames](const Status& status) { return status.frame_set == n; });
    sink.wait_for_pictures(frames);
    return measured;
  }
  ExaminingSink sink;  // outlives the pipeline
  SettableCamera* camera = nullptr;
  std::optional<Pipeline> pipeline;
  std::uint64_t frames = 0;
};

TEST_F(MeasuredPipeline, EveryStatusHasRecipeAndConfiguration) {
  std::atomic<std::uint64_t> wrong{0}, statuses{0};
  sink.on_status = [&](const Status& status) {
    ++statuses;
    wrong += status.configuration_checksum != kChecksum ? 1U : 0U;
    wrong += status.recipe != 1 && status.recipe != 2 ? 1U : 0U;
  };
  start({plan(1), plan(2)});
  sink.wait_for([](const Status& status) { return status.heartbeat > 1; });
  next_frame();
  ASSERT_EQ(pipeline->select_recipe(2), CommandResult::Done);
  sink.wait_for([](const Status& status) { return status.recipe == 2; });
  EXPECT_EQ(next_frame().recipe, 2);
  EXPECT_EQ(wrong, 0U);
  EXPECT_GT(statuses, 2U);
}

TEST_F(MeasuredPipeline, NoStatusMixesRecipesWhileTheyAreSelectedAtRandom) {
  std::map<std::uint16_t, std::uint64_t> measured;
  std::uint64_t mixed = 0, unknown_view = 0;
  std::uint16_t recipe_of_status = 0;
  sink.on_view = [&](const View& view) {
    unknown_view += view.index == kSeen || view.index == recipe_of_status ? 0U : 1U;
  };
  sink.on_status = [&](const Status& status) {
    recipe_of_status = status.recipe;
    const RegionStatus& region = status.regions[0];
    if (region.quality == Quality::NotMeasured) return;
    const double off = region.signals.hot_spot_peak_temperature - celsius(status.recipe);
    mixed += std::abs(off) < 0.1 ? 0U : 1U;
    ++measured[status.recipe];
  };
  start({plan_with_exposure(1), plan_with_exposure(2), plan_with_exposure(3)}, 3);
  {
    const std::jthread exposing([this](const std::stop_token& stop) {
      while (!stop.stop_requested()) {
        camera->expose_as_set();
        std::this_thread::sleep_for(std::chrono::microseconds(100));  // its frame period
      }
    });
    sink.wait_for([](const Status& status) { return status.frame_set > 0; });
    std::mt19937 random(5);
    for (int n = 0; n < 90; ++n) {
      const std::size_t number = 1 + random() % 3;
      ASSERT_EQ(pipeline->select_recipe(number), CommandResult::Done);
      if (n % 3 != 0) continue;
      sink.wait_for([number](const Status& status) {
        return status.recipe == number && status.regions[0].quality != Quality::NotMeasured;
      });
    }
  }
  pipeline->stop();
  EXPECT_EQ(mixed, 0U) << "the camera's setting, the scale and the number belong together";
  EXPECT_EQ(unknown_view, 0U);
  for (const std::uint16_t recipe : {1, 2, 3}) EXPECT_GT(measured[recipe], 2U) << recipe;
}

TEST_F(MeasuredPipeline, FramesFromBeforeTheCameraTookOnTheSettingsAreNotMeasured) {
  RecipePlan second = plan_with_exposure(2);
  second.settle_frames = 2;
  constexpr std::size_t kDelay = 3;
  start({plan_with_exposure(1), second}, kDelay);
  ASSERT_EQ(pipeline->select_recipe(2), CommandResult::Done);
  sink.wait_for([](const Status& status) { return status.recipe == 2; });
  for (std::size_t n = 0; n < kDelay + 2; ++n) {
    EXPECT_EQ(next_frame().regions[0].quality, Quality::NotMeasured) << n;
  }
  const RegionStatus region = next_frame().regions[0];
  EXPECT_EQ(region.quality, Quality::Apparent);
  EXPECT_NEAR(region.signals.hot_spot_peak_temperature, celsius(2), 0.1);
}

TEST_F(MeasuredPipeline, SettingsThatACameraRefusesAreReported) {
  RecipePlan impossible = plan_with_exposure(2);
  impossible.controls.push_back({{"camera", 0}, "Flux", 88});
  start({plan_with_exposure(1), impossible});
  next_frame();
  ASSERT_EQ(pipeline->select_recipe(2), CommandResult::Done);
  const Status refused = sink.wait_for([](const Status& status) { return status.recipe_refused; });
  EXPECT_EQ(refused.recipe, 1);
  const Status after = next_frame();
  EXPECT_EQ(after.recipe, 1);
  EXPECT_NEAR(after.regions[0].signals.hot_spot_peak_temperature, celsius(1), 0.1)
      << "the camera went back to what it was set to";
}

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

/// The parameter: number of recipes that are selected one right after another.
class SelectedRecipes : public MeasuredPipeline, public testing::WithParamInterface<int> {};

TEST_P(SelectedRecipes, TheLastOneIsMeasuredAndAStopDuringTheNextEnds) {
  start({plan_with_exposure(1), plan_with_exposure(2)});
  std::uint16_t last = 1;
  for (int n = 0; n < GetParam(); ++n) {
    last = static_cast<std::uint16_t>(2 - n % 2);
    ASSERT_EQ(pipeline->select_recipe(last), CommandResult::Done);
  }
  Status status;
  const auto end = Clock::now() + seconds(30);
  do {
    status = next_frame();
  } while (status.regions[0].quality == Quality::NotMeasured && Clock::now() < end);
  EXPECT_EQ(status.recipe, last);
  EXPECT_NEAR(status.regions[0].signals.hot_spot_peak_temperature, celsius(last), 0.1);
  ASSERT_EQ(pipeline->select_recipe(3 - last), CommandResult::Done);
  pipeline->stop();
  EXPECT_EQ(sink.wait_for([](const Status&) { return true; }).frame_set, frames);
}

INSTANTIATE_TEST_SUITE_P(Selections, SelectedRecipes, testing::Range(0, 10));

}  // namespace
}  // namespace orbwatch::app::pipeline
