#include "app/daemon/recipes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <random>

#include "app/daemon/check.h"
#include "hal/frame_pool.h"

namespace orbwatch::app {
namespace {

const std::filesystem::path kShipped =
    std::filesystem::path(ORBWATCH_SOURCE_DIR) / "platform/config";

constexpr std::size_t kColour = 0, kThermal = 1;

/// The demonstration, from which each test makes its own.
Configuration demo() {
  auto configuration = load_configuration(kShipped / "demo.toml");
  EXPECT_TRUE(configuration) << configuration.error().message;
  return configuration.value_or(Configuration{});
}

Recipe& first(Configuration& configuration) { return configuration.recipes.front().recipe; }

std::vector<hal::StreamFormat> formats(const Configuration& configuration) {
  std::vector<hal::StreamFormat> formats;
  for (const CameraSettings& camera : configuration.cameras) {
    formats.push_back({camera.kelvin_per_count > 0 ? PixelFormat::Y16 : PixelFormat::Rgb,
                       {},
                       camera.width,
                       camera.height,
                       camera.frame_rate});
  }
  return formats;
}

/// A set with a picture of the thermal camera, in which every pixel differs from its neighbours.
hal::FrameSet noisy_set(const hal::StreamFormat& format) {
  auto buffer = hal::make_frame_pool(format.format, format.width, format.height, 1).acquire();
  std::mt19937 random(3);
  auto* const counts = reinterpret_cast<std::uint16_t*>(buffer->memory);
  for (int i = 0; i < format.width * format.height; ++i) {
    counts[i] = static_cast<std::uint16_t>(random() % 60000);
  }
  hal::FrameSet set;
  set.id = 1;
  set.stamp = hal::TimePoint(std::chrono::seconds(1));
  buffer->metadata.exposure_start = set.stamp;
  set.frames[kThermal] = std::move(buffer);
  return set;
}

std::vector<RegionStatus> measured(const Configuration& configuration) {
  const auto streams = formats(configuration);
  auto recipes = compile_recipes(configuration, streams);
  EXPECT_TRUE(recipes) << recipes.error().message;
  if (!recipes) return {};
  CompiledRecipe& recipe = *recipes->front();
  WorkerPool workers(0);
  const hal::FrameSet set = noisy_set(streams[kThermal]);
  for (std::size_t n = 0; n < recipe.plan().views.size(); ++n) recipe.render(n, set, workers);
  recipe.measure();
  return {recipe.regions().begin(), recipe.regions().end()};
}

/// Every signal, those that are not valid included.
void expect_same(const signals::Signals& a, const signals::Signals& b) {
  for (const signals::SignalInfo& signal : signals::kSignals) {
    const double x = a.*signal.member, y = b.*signal.member;
    EXPECT_TRUE(x == y || (std::isnan(x) && std::isnan(y)))
        << signal.name << ": " << x << ", " << y;
  }
}

TEST(Recipes, AnOutlineInDirectionsIsTheOneInPoints) {
  Configuration configuration = demo();
  RegionOfInterest& points = first(configuration).regions[0];
  ASSERT_EQ(points.points.size(), 4U);
  RegionOfInterest directions = points, whole = points;
  directions.name = "directions";
  directions.points.clear();
  whole.name = "whole";
  whole.points.clear();
  const optics::Vec3 centre = configuration.rig.ball.centre;
  for (const auto& [x, y, z] : points.points) {
    const double right = x - centre.x, forward = y - centre.y, up = z - centre.z;
    const double degrees = 180 / std::numbers::pi;
    directions.directions.push_back({std::atan2(right, forward) * degrees,
                                     std::atan2(up, std::hypot(right, forward)) * degrees});
  }
  first(configuration).regions = {points, directions, whole};
  const auto regions = measured(configuration);
  ASSERT_EQ(regions.size(), 3U);
  EXPECT_EQ(regions[0].quality, Quality::Apparent);
  EXPECT_GT(regions[0].signals.hot_spot_pixels, 10);
  expect_same(regions[0].signals, regions[1].signals);
  EXPECT_NE(regions[0].signals.hot_spot_pixels, regions[2].signals.hot_spot_pixels);
}

TEST(Recipes, TemperaturesAreTrueOnesOnceBallAndTargetAreKnown) {
  Configuration configuration = demo();
  const auto peak = [&] { return measured(configuration)[0]; };
  const RegionStatus apparent = peak();
  EXPECT_EQ(apparent.quality, Quality::Apparent);
  configuration.cameras[kThermal].radiometry = RadiometrySettings{10, 0.8, 20};
  const RegionStatus behind_the_ball = peak();
  EXPECT_EQ(behind_the_ball.quality, Quality::Apparent);
  first(configuration).regions[0].emissivity = 0.5;
  const RegionStatus true_ones = peak();
  EXPECT_EQ(true_ones.quality, Quality::Good);
  EXPECT_GT(behind_the_ball.signals.hot_spot_peak_temperature,
            apparent.signals.hot_spot_peak_temperature + 100);
  EXPECT_GT(true_ones.signals.hot_spot_peak_temperature,
            behind_the_ball.signals.hot_spot_peak_temperature + 100);
}

TEST(Recipes, AThresholdIsATemperatureOfTheTarget) {
  Configuration configuration = demo();
  configuration.cameras[kThermal].radiometry = RadiometrySettings{10, 0.7, 20};
  first(configuration).regions[0].emissivity = 0.6;
  const auto regions = measured(configuration);
  const signals::Signals& signals = regions[0].signals;
  ASSERT_GT(signals.hot_spot_pixels, 0);
  EXPECT_GT(signals.hot_spot_mean_temperature, 1400) << "all of the spot is above its threshold";
}

TEST(Recipes, AlarmsOnWhatNeverHasAValueAreRefused) {
  const auto refusal = [](const std::string& signal, auto spoil) {
    Configuration configuration = demo();
    RegionOfInterest& region = first(configuration).regions[0];
    AlarmSettings alarm;
    alarm.signal = signal;
    alarm.high_alarm = 1;
    region.alarms = {alarm};
    spoil(configuration, region);
    const auto recipes = compile_recipes(configuration, formats(configuration));
    return recipes ? "none" : recipes.error().message;
  };
  const auto expect = [&](const std::string& signal, const std::string& what, auto spoil) {
    EXPECT_THAT(refusal(signal, spoil),
                testing::EndsWith(signal + ", which has no value without " + what));
  };
  expect("spatter_rate", "the region's spatter_threshold",
         [](auto&, auto& region) { region.spatter_threshold.reset(); });
  expect("plume_area", "the region's plume_threshold",
         [](auto&, auto& region) { region.plume_threshold.reset(); });
  expect("hot_spot_width_error", "the region's width",
         [](auto&, auto& region) { region.width.reset(); });
  expect("hot_spot_area_mean", "the rig's scene",
         [](auto& configuration, auto&) { configuration.rig.scene = {}; });
  EXPECT_EQ(refusal("hot_spot_pixels", [](auto&, auto&) {}), "none");
}

TEST(Recipes, ARegionBehindTheBallIsRefused) {
  Configuration configuration = demo();
  MeasuredViewSettings& view = first(configuration).views[0];
  view.yaw = 168.1;  // the ball's far side, as the thermal camera stands
  view.pitch = -11.6;
  view.h_fov = 6;
  first(configuration).regions[0].points.clear();
  const auto refusal = [&] {
    const auto recipes = compile_recipes(configuration, formats(configuration));
    return recipes ? "none" : recipes.error().message;
  };
  EXPECT_THAT(refusal(), testing::HasSubstr("that the measured camera sees"));
  view.yaw = -115;
  EXPECT_EQ(refusal(), "none");
}

TEST(Recipes, EachHasItsNumberItsViewsAndItsControls) {
  Configuration configuration = demo();
  RecipeSettings second = configuration.recipes[0];
  second.number = 7;
  second.recipe.views[0].name = "other";
  for (RegionOfInterest& region : second.recipe.regions) region.view = "other";
  configuration.recipes[0].recipe.controls = {{1, "thermal", "Gain", 1}};
  second.recipe.controls = {{1, "thermal", "Gain", 4}};
  second.recipe.settle_frames = 5;
  configuration.recipes.push_back(second);
  const auto recipes = compile_recipes(configuration, formats(configuration));
  ASSERT_TRUE(recipes) << recipes.error().message;
  ASSERT_EQ(recipes->size(), 2U);
  const RecipePlan& one = (*recipes)[0]->plan();
  const RecipePlan& two = (*recipes)[1]->plan();
  EXPECT_EQ(one.number, 1);
  EXPECT_EQ(two.number, 7);
  EXPECT_EQ(one.views[0].index, configuration.views.size()) << "after those to look at";
  EXPECT_EQ(two.views[0].index, configuration.views.size() + 1);
  EXPECT_EQ(two.controls[0].camera, kThermal);
  EXPECT_EQ(two.controls[0].value, 4);
  EXPECT_EQ(two.settle_frames, 5);
  EXPECT_EQ(one.alarms.size(), 2U);
}

TEST(Recipes, TheProcessInputIsCountedAmongTheProcessInputs) {
  Configuration configuration = demo();
  for (const auto& [name, use] :
       {std::pair{"start", LineUse::TriggerIn}, std::pair{"door", LineUse::ProcessInput},
        std::pair{"ok", LineUse::ProcessOk}, std::pair{"laser", LineUse::ProcessInput}}) {
    LineSettings line;
    line.name = name;
    line.use = use;
    configuration.lines.push_back(line);
  }
  first(configuration).process_active = ActiveSource::Input;
  first(configuration).process_input = "laser";
  const auto recipes = compile_recipes(configuration, formats(configuration));
  ASSERT_TRUE(recipes);
  EXPECT_EQ((*recipes)[0]->plan().process_input, 1U);
}

TEST(Check, WhatIsShippedCanRun) {
  for (const char* file : {"demo.toml", "usb-camera.toml"}) {
    const auto checked = load_configuration(kShipped / file).and_then(check_plans);
    EXPECT_TRUE(checked) << checked.error().message;
  }
}

/// What a change makes of the demonstration.
template <class Change>
std::string refusal(const Change& change) {
  Configuration configuration = demo();
  change(configuration);
  const auto checked = check_plans(configuration);
  return checked ? "none" : checked.error().message;
}

TEST(Check, FindsRegionsOutsideOfTheirView) {
  const std::string said = refusal([](Configuration& configuration) {
    first(configuration).regions[0].points.clear();
    first(configuration).regions[0].directions = {{60, 40}, {70, 40}, {60, 50}};
  });
  EXPECT_NE(said.find("demo-recipe.toml: region pool: "), std::string::npos) << said;
  EXPECT_NE(said.find("no pixel"), std::string::npos) << said;
}

TEST(Check, FindsThresholdsThatNothingReaches) {
  const auto hotter_than_the_scale = [](Configuration& configuration) {
    first(configuration).regions[0].hot_spot_threshold = 9000;
  };
  EXPECT_NE(refusal(hotter_than_the_scale).find("region pool: "), std::string::npos)
      << refusal(hotter_than_the_scale);
  const auto above_full_scale = [](Configuration& configuration) {
    configuration.cameras[kThermal].kelvin_per_count = 0;
    for (RegionOfInterest& region : first(configuration).regions) region.alarms.clear();
    first(configuration).regions[1].spatter_threshold.reset();
    first(configuration).regions[0].plume_threshold.reset();
    first(configuration).regions[0].hot_spot_threshold = 101;
    first(configuration).regions[1].hot_spot_threshold = 99;
  };
  EXPECT_NE(refusal(above_full_scale).find("region pool: "), std::string::npos)
      << refusal(above_full_scale);
  EXPECT_EQ(refusal([&](Configuration& configuration) {
              above_full_scale(configuration);
              first(configuration).regions[0].hot_spot_threshold = 99;
            }),
            "none");
}

}  // namespace
}  // namespace orbwatch::app
