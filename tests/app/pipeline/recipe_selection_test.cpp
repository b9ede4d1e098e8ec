// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <map>
#include <random>
#include <thread>

#include "tests/app/pipeline/measured_pipeline_case.h"

/// Recipes that are selected while a camera delivers, with the settings that they have for it.
namespace orbwatch::app::pipeline {
namespace {

using hal::Clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

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

TEST_F(MeasuredPipeline, ARecipeThatWasSelectedBeforeTheStartIsSetAfterIt) {
  make({plan_with_exposure(1), plan_with_exposure(2)});
  ASSERT_EQ(pipeline->select_recipe(2), CommandResult::Done);
  EXPECT_FALSE(camera->wait_for_settings(2, milliseconds(50))) << "it would be free to rescale";
  ASSERT_TRUE(pipeline->start({&sink}));
  EXPECT_TRUE(camera->wait_for_settings(2, seconds(30)));
  sink.wait_for([](const Status& status) { return status.recipe == 2; });
  const Status status = next_frame();
  EXPECT_EQ(status.recipe, 2);
  EXPECT_NEAR(status.regions[0].signals.hot_spot_peak_temperature, celsius(2), 0.1);
}

TEST_F(MeasuredPipeline, ARecipeIsSelectedWhileItsCameraIsUnplugged) {
  constexpr std::size_t kDelay = 2;
  start({plan_with_exposure(1), plan_with_exposure(2)}, kDelay);
  camera->unplug();
  ASSERT_EQ(pipeline->select_recipe(2), CommandResult::Done);
  const Status selected = sink.wait_for(
      [](const Status& status) { return status.recipe == 2 || status.recipe_refused; });
  EXPECT_EQ(selected.recipe, 2);
  EXPECT_FALSE(selected.recipe_refused);
  camera->plug();
  for (std::size_t n = 0; n < kDelay; ++n) {
    EXPECT_EQ(next_frame().regions[0].quality, Quality::NotMeasured) << n;
  }
  EXPECT_NEAR(next_frame().regions[0].signals.hot_spot_peak_temperature, celsius(2), 0.1);
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
