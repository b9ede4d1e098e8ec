// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "app/pipeline/measurement/measurement.h"
#include "tests/app/pipeline/hand_camera.h"
#include "tests/app/pipeline/measurement/measured_recipe.h"
#include "tests/app/pipeline/views/rendered_view.h"
#include "tests/app/pipeline/views/thermal_view.h"

namespace orbwatch::app::pipeline {

inline constexpr std::uint16_t kBright = 40000;

/// Scale of each recipe; the recipes measure the same picture, so that a value identifies its
/// recipe.
inline double scale(std::uint16_t recipe) { return recipe == 1 ? 0.04 : 0.02; }
inline double celsius(std::uint16_t recipe, std::uint16_t bright = kBright) {
  return bright * scale(recipe) - 273.15;
}

inline RecipePlan plan(std::uint16_t number) {
  return recipe_plan(thermal_view(0, "measured"), 30000, scale(number), number);
}

inline std::size_t signal(std::string_view name) {
  return static_cast<std::size_t>(
      std::ranges::find(signals::kSignals, name, &signals::SignalInfo::name) -
      signals::kSignals.begin());
}

/// Alarm above this temperature, without a delay.
inline signals::AlarmLimits hotter_than(double celsius) {
  signals::AlarmLimits limits;
  limits.signal = signal("hot_spot_peak_temperature");
  limits.high_alarm = celsius;
  limits.loss_delay.reset();
  return limits;
}

/// One camera, whose frame sets the test processes one after the other.
class MeasurementTest : public testing::Test {
 protected:
  MeasurementTest() {
    EXPECT_TRUE(camera.configure({}));
    EXPECT_TRUE(camera.start([this](hal::Frame taken) { frame = std::move(taken); },
                             [](const hal::FaultReport&) {}));
  }
  ~MeasurementTest() override { camera.stop(); }

  void measure_by(std::vector<RecipePlan> plans, RecipeSwitch::Apply apply = nullptr) {
    std::vector<std::unique_ptr<CompiledRecipe>> recipes;
    for (RecipePlan& plan : plans) recipes.push_back(compiled(std::move(plan)));
    measurement.emplace(std::move(recipes), inputs, std::move(apply));
    buffers.emplace(ViewBuffers::Views(), measurement->planned_views(), KeptViews{});
    measurement->start();
  }
  void measure_by_two() { measure_by({plan(1), plan(2)}); }

  CommandResult select(std::size_t recipe) { return measurement->select_recipe(recipe); }

  /// Processes a set of a frame that is exposed at that moment.
  Status expose(std::optional<std::uint64_t> trigger = {}, hal::TimePoint stamp = hal::Clock::now(),
                std::uint16_t bright = kBright) {
    camera.expose(bright, stamp);
    return process(stamp, trigger);
  }
  /// Processes a set with the existing frame, exposed earlier.
  Status process(hal::TimePoint stamp, std::optional<std::uint64_t> trigger = {},
                 bool held = false) {
    hal::FrameSet set;
    set.id = ++sets;
    set.stamp = stamp;
    set.trigger = trigger;
    set.frames[0] = frame;
    set.held[0] = held;
    measurement->apply_commands(stamp);
    PictureUses uses;
    for (const ViewChannel& view : measurement->views()) view.add_measured_use(uses);
    pyramids.build(set, uses, workers);
    measurement->render(set, pyramids, *buffers, workers);
    measurement->measure(set);
    for (ViewChannel& channel : measurement->views()) {
      const ViewPtr view = channel.take();
      published += view && view->frame_set == sets ? 1 : 0;
    }
    return status();
  }
  Status idle(bool blind = false) {
    measurement->apply_commands(hal::Clock::now());
    measurement->idle(blind);
    return status();
  }
  Status status() {
    measurement->watch(hal::Clock::now(), [this](const AlarmNotice& notice) {
      EXPECT_EQ(notice.number, notices.size() + 1) << "without gaps";
      notices.push_back(notice);
    });
    Status status;
    measurement->report(status);
    return status;
  }

  /// True if the measurement belongs to the recipe of the status.
  static bool is_measured(const Status& status, std::uint16_t bright = kBright) {
    if (status.regions[0].quality == Quality::NotMeasured) {
      EXPECT_FALSE(signals::is_valid(status.regions[0].signals.hot_spot_peak_temperature));
      return false;
    }
    EXPECT_NEAR(status.regions[0].signals.hot_spot_peak_temperature, celsius(status.recipe, bright),
                0.1)
        << "of recipe " << status.recipe;
    return true;
  }
  /// Exposes until frames count again.
  Status expose_until_measured() {
    const auto end = hal::Clock::now() + std::chrono::seconds(30);
    Status status = expose();
    while (!is_measured(status) && hal::Clock::now() < end) status = expose();
    EXPECT_TRUE(is_measured(status));
    return status;
  }

  HandCamera camera{"thermal", PixelFormat::Y16};
  hal::Frame frame;
  Measurement::ProcessInputs inputs;
  WorkerPool workers{0};
  FramePyramids pyramids{source_formats(thermal_view(0, "measured"))};
  std::optional<Measurement> measurement;
  std::optional<ViewBuffers> buffers;
  std::uint64_t sets = 0;
  std::uint64_t published = 0;
  std::vector<AlarmNotice> notices;
};

}  // namespace orbwatch::app::pipeline
