// SPDX-License-Identifier: Apache-2.0
#include "app/daemon/site/build.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <random>

#include "hal/frame/frame_pool.h"
#include "tests/app/daemon/demo_site.h"

namespace orbwatch::app::daemon {
namespace {

std::vector<hal::StreamFormat> formats(const files::Resolved& site) {
  std::vector<hal::StreamFormat> formats;
  for (const files::CameraSettings& camera : site.site.cameras) {
    formats.push_back({camera.radiometry.kelvin_per_count > 0 ? PixelFormat::Y16 : PixelFormat::Rgb,
                       {},
                       camera.stream.width,
                       camera.stream.height,
                       camera.stream.frame_rate,
                       camera.radiometry.kelvin_per_count});
  }
  return formats;
}

Result<pipeline::PipelinePlan> built(const files::Resolved& site) {
  return SitePlan::make(site, formats(site)).and_then([&](const SitePlan& plan) {
    return build(site, plan);
  });
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
  set.frames[kThermalCamera] = std::move(buffer);
  return set;
}

std::vector<RegionStatus> measured(const files::Resolved& site) {
  const auto streams = formats(site);
  auto plan = built(site);
  EXPECT_TRUE(plan) << plan.error().message;
  if (!plan) return {};
  pipeline::CompiledRecipe& recipe = *plan->recipes.front();
  pipeline::WorkerPool workers(0);
  const hal::FrameSet set = noisy_set(streams[kThermalCamera]);
  pipeline::PictureUses uses;
  for (const pipeline::ViewChannel& view : recipe.views()) view.add_measured_use(uses);
  pipeline::FramePyramids pyramids(streams, uses);
  pyramids.build(set, uses, workers);
  pipeline::ViewBuffers buffers({}, {recipe.plan().views}, {});
  recipe.render(set, pyramids, buffers, workers);
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

TEST(Build, AnOutlineInDirectionsIsTheOneInPoints) {
  files::Resolved site = demo();
  pipeline::RegionOfInterest& points = first(site).regions[0];
  ASSERT_EQ(points.points.size(), 4U);
  pipeline::RegionOfInterest directions = points, whole = points;
  directions.name = "directions";
  directions.points.clear();
  whole.name = "whole";
  whole.points.clear();
  const optics::Vec3 centre = site.rig.ball.centre;
  for (const auto& [x, y, z] : points.points) {
    const double right = x - centre.x, forward = y - centre.y, up = z - centre.z;
    const double degrees = 180 / std::numbers::pi;
    directions.directions.push_back({std::atan2(right, forward) * degrees,
                                     std::atan2(up, std::hypot(right, forward)) * degrees});
  }
  first(site).regions = {{points}, {directions}, {whole}};
  const auto regions = measured(site);
  ASSERT_EQ(regions.size(), 3U);
  EXPECT_EQ(regions[0].quality, Quality::Apparent);
  EXPECT_GT(regions[0].signals.hot_spot_pixels, 10);
  expect_same(regions[0].signals, regions[1].signals);
  EXPECT_NE(regions[0].signals.hot_spot_pixels, regions[2].signals.hot_spot_pixels);
}

TEST(Build, TemperaturesAreTrueOnesOnceBallAndTargetAreKnown) {
  files::Resolved site = demo();
  const auto peak = [&] { return measured(site)[0]; };
  const RegionStatus apparent = peak();
  EXPECT_EQ(apparent.quality, Quality::Apparent);
  site.site.cameras[kThermalCamera].radiometry.reflectivity = 0.8;
  const RegionStatus behind_the_ball = peak();
  EXPECT_EQ(behind_the_ball.quality, Quality::Apparent);
  first(site).regions[0].emissivity = 0.5;
  const RegionStatus true_ones = peak();
  EXPECT_EQ(true_ones.quality, Quality::Good);
  EXPECT_GT(behind_the_ball.signals.hot_spot_peak_temperature,
            apparent.signals.hot_spot_peak_temperature + 100);
  EXPECT_GT(true_ones.signals.hot_spot_peak_temperature,
            behind_the_ball.signals.hot_spot_peak_temperature + 100);
}

TEST(Build, AThresholdIsATemperatureOfTheTarget) {
  files::Resolved site = demo();
  site.site.cameras[kThermalCamera].radiometry.reflectivity = 0.7;
  first(site).regions[0].emissivity = 0.6;
  const auto regions = measured(site);
  const signals::Signals& signals = regions[0].signals;
  ASSERT_GT(signals.hot_spot_pixels, 0);
  EXPECT_GT(signals.hot_spot_mean_temperature, 1400) << "all of the spot is above its threshold";
}

TEST(Build, AlarmsOnWhatNeverHasAValueAreRefused) {
  const auto refusal = [](const std::string& signal, auto spoil) {
    files::Resolved site = demo();
    pipeline::RegionOfInterest& region = first(site).regions[0];
    signals::AlarmLimits alarm;
    alarm.signal = *find_word(signals::kSignalWords, signal);
    alarm.high_alarm = 1;
    region.alarms = {{alarm}};
    spoil(site, region);
    const auto plan = built(site);
    return plan ? "none" : plan.error().message;
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
  expect("hot_spot_area_mean", "the rig's scene", [](auto& site, auto&) { site.rig.scene = {}; });
  EXPECT_EQ(refusal("hot_spot_pixels", [](auto&, auto&) {}), "none");
}

TEST(Build, ARegionBehindTheBallIsRefused) {
  files::Resolved site = demo();
  pipeline::MeasuredViewSettings& view = first(site).views[0];
  view.yaw = 168.1;  // the ball's far side, as the thermal camera stands
  view.pitch = -11.6;
  view.h_fov = 6;
  first(site).regions[0].points.clear();
  const auto refusal = [&] {
    const auto plan = built(site);
    return plan ? "none" : plan.error().message;
  };
  EXPECT_THAT(refusal(), testing::HasSubstr("that the measured camera sees"));
  view.yaw = -115;
  EXPECT_EQ(refusal(), "none");
}

TEST(Build, EachHasItsNumberItsViewsAndItsControls) {
  files::Resolved site = demo();
  pipeline::Recipe second = first(site);
  second.views[0].name = "other";
  for (pipeline::RegionOfInterest& region : second.regions) region.view.name = "other";
  first(site).controls = {{{{"thermal"}, "Gain", 1}, 1}};
  second.controls = {{{{"thermal"}, "Gain", 4}, 1}};
  second.settle_frames = 5;
  site.recipes.push_back(second);
  site.site.recipes.push_back(site.site.recipes.front());
  site.site.recipes.back().number = 7;
  const auto resolved = resolve_references(site, "site.toml");
  ASSERT_TRUE(resolved) << resolved.error().message;
  const auto plan = built(site);
  ASSERT_TRUE(plan) << plan.error().message;
  ASSERT_EQ(plan->recipes.size(), 2U);
  const pipeline::RecipePlan& one = plan->recipes[0]->plan();
  const pipeline::RecipePlan& two = plan->recipes[1]->plan();
  EXPECT_EQ(one.number, 1);
  EXPECT_EQ(two.number, 7);
  EXPECT_EQ(one.views[0].index, site.site.views.size()) << "after those to look at";
  EXPECT_EQ(two.views[0].index, site.site.views.size() + 1);
  EXPECT_EQ(two.controls[0].camera.index, kThermalCamera);
  EXPECT_EQ(two.controls[0].value, 4);
  EXPECT_EQ(two.settle_frames, 5);
  EXPECT_EQ(one.alarms.size(), 2U);
}

TEST(Build, TheProcessInputIsCountedAmongTheProcessInputs) {
  files::Resolved site = demo();
  for (const auto& [name, use] :
       {std::pair{"start", LineUse::TriggerIn}, std::pair{"door", LineUse::ProcessInput},
        std::pair{"ok", LineUse::ProcessOk}, std::pair{"laser", LineUse::ProcessInput}}) {
    Located<LineSettings> line;
    line.name = name;
    line.use = use;
    site.site.lines.push_back(line);
  }
  first(site).process_active = pipeline::ActiveSource::Input;
  first(site).process_input.name = "laser";
  ASSERT_TRUE(resolve_references(site, "site.toml"));
  const auto plan = built(site);
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->recipes[0]->plan().process_input, 1U);
}

/// The demo's site, of whose cameras nobody knows where one looks.
files::Resolved with_unregistered(std::size_t camera) {
  files::Resolved site = demo();
  site.rig.cameras[site.rig_cameras[camera]].is_registered = false;
  return site;
}

TEST(Build, AnUnregisteredCameraIsLeftOutOfMergedViews) {
  files::Resolved site = with_unregistered(kThermalCamera);
  site.recipes.clear();
  pipeline::ViewSettings alone = site.site.views.front();
  alone.name = "alone";
  alone.sources.erase(alone.sources.begin() + 1, alone.sources.end());
  alone.sources.front().camera.index = kThermalCamera;
  pipeline::ViewSettings merged = alone;
  merged.sources.push_back(merged.sources.front());
  merged.sources.back().camera.index = 0;
  site.site.views = {{alone}, {merged}};
  const auto plan = built(site);
  ASSERT_TRUE(plan) << plan.error().message;
  ASSERT_EQ(plan->views[0].sources.size(), 1U);
  EXPECT_EQ(plan->views[0].sources[0].camera, kThermalCamera) << "as it is";
  ASSERT_EQ(plan->views[1].sources.size(), 1U);
  EXPECT_EQ(plan->views[1].sources[0].camera, 0U);
}

/// Another camera of a measured view is left out, and the one that measures is found again.
TEST(Build, AnUnregisteredCameraIsLeftOutOfMeasuredViews) {
  files::Resolved site = with_unregistered(0);
  for (pipeline::MeasuredViewSettings& view : first(site).views) {
    ASSERT_EQ(view.sources[view.measured.index].camera.index, kThermalCamera);
  }
  const auto plan = built(site);
  ASSERT_TRUE(plan) << plan.error().message;
  for (const pipeline::ViewPlan& view : plan->recipes.front()->plan().views) {
    ASSERT_EQ(view.sources.size(), 1U);
    EXPECT_EQ(view.measured, 0U);
    EXPECT_EQ(view.sources[0].camera, kThermalCamera);
  }
}

}  // namespace
}  // namespace orbwatch::app::daemon
