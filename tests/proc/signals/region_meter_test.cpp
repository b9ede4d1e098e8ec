// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/region_meter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <numbers>
#include <random>
#include <utility>

#include "proc/signals/signal_list.h"
#include "tests/proc/signals/painted_region.h"

namespace orbwatch::signals {
namespace {

using optics::Vec3;
using optics::ViewKind;

const optics::ViewSpec kView{ViewKind::Perspective, {30, -10, 5}, 60, {}, 240, 180};

RegionSettings settings() {
  RegionSettings region;
  region.hot_spot_threshold = kHotSpotThreshold;
  region.plume_threshold = 10000;
  region.spatter_threshold = 5000;
  return region;
}

RegionMeter meter_of(const PaintedView& painted, const RegionSettings& region,
                     const RegionScene& scene = {}) {
  return RegionMeter::make(painted.view, scene, region).value();
}

double cap(double radius) { return 2000 * std::numbers::pi * (1 - std::cos(radius)); }

TEST(RegionMeter, AHillIsItsCapOnTheSphere) {
  for (const auto& spec :
       {kView, optics::ViewSpec{ViewKind::Equirectangular, {}, {}, {}, 720, 360}}) {
    PaintedView painted(spec);
    RegionMeter meter = meter_of(painted, settings());
    const Vec3 centre = *painted.view.direction(spec.width * 0.7, spec.height * 0.3);
    const double radius = 0.06;
    painted.paint_hill(centre, radius, kHotSpotThreshold);
    const Signals s = meter.measure(painted.plane(), painted.seen(), 1);
    EXPECT_EQ(s.hot_spot_present, 1);
    EXPECT_NEAR(s.hot_spot_solid_angle, cap(radius), 0.01 * cap(radius));
    EXPECT_NEAR(s.hot_spot_yaw, optics::degrees(std::atan2(centre.x, centre.y)), 0.02);
    EXPECT_NEAR(s.hot_spot_pitch, optics::degrees(std::asin(centre.z)), 0.02);
    EXPECT_NEAR(s.hot_spot_length_angle, optics::degrees(2 * radius), 0.05);
    EXPECT_NEAR(s.hot_spot_width_angle, optics::degrees(2 * radius), 0.05);
    EXPECT_FALSE(is_valid(s.hot_spot_orientation)) << "a disc has none";
    // The value is below the plume's threshold where 1.5 (2/3)^(s^2) is a half.
    const double plume = radius * std::sqrt(std::log(3) / std::log(1.5));
    EXPECT_NEAR(s.plume_area, cap(plume) - cap(radius), 0.01 * cap(plume));
    EXPECT_NEAR(s.hot_spot_peak_intensity, 100 * 30000 / 65535.0, 0.1);
    EXPECT_EQ(s.hot_spot_saturated, 0);
    EXPECT_FALSE(is_valid(s.hot_spot_peak_temperature)) << "not radiometric";
    EXPECT_FALSE(is_valid(s.hot_spot_area)) << "the machine is not known";
    EXPECT_EQ(s.spatter_count, 0);
  }
}

TEST(RegionMeter, AnEllipseOnTheFloorHasItsAxesInMillimetres) {
  const RegionScene scene = floor_scene();
  PaintedView painted({ViewKind::Perspective, {30, -50, 20}, 30, {}, 320, 240});
  RegionSettings region = settings();
  region.width_set_point = 20;
  region.radiometry.kelvin_per_count = 0.04;
  RegionMeter meter = meter_of(painted, region, scene);
  for (const double turned : {-60.0, 10.0, 75.0}) {
    // Half axes of 20 and 12 mm about (170, 260, -300), the long one turned from +X towards +Y.
    const Vec3 centre{170, 260, -300};
    const double c = std::cos(optics::radians(turned)), s = std::sin(optics::radians(turned));
    painted.clear();
    painted.paint([&](const Vec3& d) {
      if (d.z >= 0) return 0.0;
      const Vec3 p = scene.ball.centre + d * ((centre.z - scene.ball.centre.z) / d.z) - centre;
      const double a = (c * p.x + s * p.y) / 20, b = (c * p.y - s * p.x) / 12;
      return 1.5 * kHotSpotThreshold * std::pow(2.0 / 3, a * a + b * b);
    });
    const Signals signals = meter.measure(painted.plane(), painted.seen(), 1);
    EXPECT_NEAR(signals.hot_spot_area, std::numbers::pi * 20 * 12, 0.01 * 754);
    EXPECT_NEAR(signals.hot_spot_length, 40, 0.3);
    EXPECT_NEAR(signals.hot_spot_width, 24, 0.3);
    EXPECT_NEAR(signals.hot_spot_width_error, 4, 0.3);
    EXPECT_NEAR(signals.hot_spot_orientation_xy, turned, 1);
    EXPECT_NEAR(signals.hot_spot_x, centre.x, 0.2);
    EXPECT_NEAR(signals.hot_spot_y, centre.y, 0.2);
    EXPECT_NEAR(signals.hot_spot_z, centre.z, 0.01);
    // A Gaussian's mean over the area above: 30000 (1 - 2/3) / ln(3/2) counts.
    EXPECT_NEAR(signals.hot_spot_mean_temperature, 0.04 * 10000 / std::log(1.5) - 273.15, 5);
    EXPECT_NEAR(signals.hot_spot_peak_temperature, 0.04 * 30000 - 273.15, 5);
  }
}

TEST(RegionMeter, OrientationIsAgainstTheHorizontal) {
  PaintedView painted({ViewKind::Perspective, {40, 20, 0}, 40, {}, 240, 180});
  RegionMeter meter = meter_of(painted, settings());
  const Vec3 d = *painted.view.direction(119.5, 89.5);
  const Vec3 right = optics::normalized({d.y, -d.x, 0}), up = optics::cross(right, d);
  for (const double angle : {-70.0, -20.0, 0.0, 45.0, 89.0}) {
    const double c = std::cos(optics::radians(angle)), s = std::sin(optics::radians(angle));
    painted.clear();
    painted.paint([&](const Vec3& p) {
      const double a = (c * optics::dot(p, right) + s * optics::dot(p, up)) / 0.10;
      const double b = (c * optics::dot(p, up) - s * optics::dot(p, right)) / 0.05;
      return 1.5 * kHotSpotThreshold * std::pow(2.0 / 3, a * a + b * b);
    });
    const Signals signals = meter.measure(painted.plane(), painted.seen(), 1);
    EXPECT_NEAR(std::remainder(signals.hot_spot_orientation - angle, 180), 0, 0.5) << angle;
  }
}

TEST(RegionMeter, TheLargestBlobIsTheHotSpotAndTheOthersAreSparks) {
  PaintedView painted(kView);
  RegionMeter meter = meter_of(painted, settings());
  const Vec3 pool = *painted.view.direction(70, 120), spark = *painted.view.direction(190, 40);
  painted.paint_hill(pool, 0.05, kHotSpotThreshold);
  painted.paint_hill(spark, 0.01, 40000);
  const Signals s = meter.measure(painted.plane(), painted.seen(), 1);
  EXPECT_NEAR(s.hot_spot_peak_intensity, 100 * 30000 / 65535.0, 0.1);
  EXPECT_EQ(s.spatter_count, 1);
  EXPECT_EQ(s.spatter_rate, 1);
}

TEST(RegionMeter, ASparkAsLargeAsThePoolDoesNotTakeItsPlace) {
  PaintedView painted(kView);
  RegionMeter meter = meter_of(painted, settings());
  const Vec3 pool = *painted.view.direction(60, 120);
  painted.paint_hill(pool, 0.03, kHotSpotThreshold);
  meter.measure(painted.plane(), painted.seen(), 0);
  for (int i = 1; i < 6; ++i) {
    painted.clear();
    painted.paint_hill(pool, 0.03, kHotSpotThreshold);
    painted.paint_hill(*painted.view.direction(100 + 20 * i, 120 - 15 * i), 0.04,
                       kHotSpotThreshold);
    const Signals s = meter.measure(painted.plane(), painted.seen(), i / 30.0);
    EXPECT_NEAR(s.hot_spot_yaw, optics::degrees(std::atan2(pool.x, pool.y)), 0.1);
    EXPECT_EQ(s.spatter_count, 1);
    EXPECT_EQ(s.spatter_rate, 1);
  }
}

TEST(RegionMeter, WhatIsNotSeenOrOutsideDoesNotCount) {
  PaintedView painted(kView);
  const Vec3 pool = *painted.view.direction(70, 120);
  painted.paint_hill(pool, 0.05, kHotSpotThreshold);
  RegionSettings region = settings();
  for (const auto& [x, y] : {std::pair{150, 10}, {230, 10}, {230, 170}, {150, 170}}) {
    region.outline.push_back(*painted.view.direction(x, y));
  }
  RegionMeter beside = meter_of(painted, region);
  Signals s = beside.measure(painted.plane(), painted.seen(), 1);
  EXPECT_EQ(s.hot_spot_present, 0);
  EXPECT_EQ(s.hot_spot_solid_angle, 0);
  EXPECT_FALSE(is_valid(s.hot_spot_yaw));
  EXPECT_EQ(s.spatter_count, 0);
  RegionMeter all = meter_of(painted, settings());
  std::ranges::fill(painted.validity, static_cast<std::uint8_t>(Validity::Blind));
  s = all.measure(painted.plane(), painted.seen(), 1);
  EXPECT_EQ(s.hot_spot_present, 0);
}

TEST(RegionMeter, ARegionsBorderCutsToWithinAQuarterPixel) {
  PaintedView painted(kView, 40000);  // hot all over
  RegionSettings region = settings();
  for (const auto& [x, y] : {std::pair{20.5, 30.5}, {120.5, 30.5}, {120.5, 90.5}, {20.5, 90.5}}) {
    region.outline.push_back(*painted.view.direction(x, y));
  }
  RegionMeter meter = meter_of(painted, region);
  const Signals s = meter.measure(painted.plane(), painted.seen(), 1);
  EXPECT_NEAR(s.hot_spot_pixels, 100 * 60, 1e-6);
  EXPECT_EQ(s.plume_area, 0);
}

/// Compares blobs of random pictures with a flood fill.
TEST(RegionMeter, FindsTheBlobsThatAFloodFillFinds) {
  PaintedView painted({ViewKind::Perspective, {}, 60, {}, 47, 33});
  const auto mask = RegionMask::make(painted.view, {}).value();
  const RegionGeometry geometry(painted.view, {}, mask);
  std::mt19937 random(6);
  for (int round = 0; round < 200; ++round) {
    for (auto& value : painted.values) value = static_cast<std::uint16_t>(random() % 100);
    const int low = 20 + static_cast<int>(random() % 40),
              high = low + 1 + static_cast<int>(random() % 30);
    Components lower(mask), upper(mask);
    lower.find(painted.plane(), painted.seen(), low, mask);
    upper.find(painted.plane(), painted.seen(), high - 0.5, lower);
    LevelSet blobs;
    blobs.reserve(mask);
    for (const auto& [level, threshold] : {std::pair{&lower, low}, {&upper, high}}) {
      std::vector<bool> done(painted.values.size());
      std::vector<double> expected, found;
      for (int start = 0; start < 47 * 33; ++start) {
        std::vector<int> open{start};
        double area = 0;
        while (!open.empty()) {
          const int i = open.back(), x = i % 47, y = i / 47;
          open.pop_back();
          if (done[i] || painted.values[i] < threshold) continue;
          done[i] = true;
          area += painted.view.solid_angle(x, y);
          for (int v = std::max(0, y - 1); v <= std::min(32, y + 1); ++v) {
            for (int u = std::max(0, x - 1); u <= std::min(46, x + 1); ++u) {
              open.push_back(v * 47 + u);
            }
          }
        }
        if (area > 0) expected.push_back(area);
      }
      for (std::size_t i = 0; i < level->runs().size(); ++i) {
        if (level->pixels(i) == 0) continue;
        blobs.find(painted.plane(), painted.seen(), threshold, *level, i, geometry);
        blobs.for_each_blob([&](const Blob& blob) { found.push_back(blob.solid_angle); });
      }
      std::ranges::sort(expected);
      std::ranges::sort(found);
      ASSERT_EQ(found.size(), expected.size()) << "round " << round;
      for (std::size_t i = 0; i < found.size(); ++i) ASSERT_NEAR(found[i], expected[i], 1e-6);
    }
  }
}

TEST(RegionMeter, RegionsThatShareTheMemoryOfTheirSearchMeasureTheSame) {
  PaintedView painted(kView);
  std::vector<RegionSettings> regions(3, settings());
  // The small region comes first, so the memory grows.
  for (const auto& [x, y] : {std::pair(80, 60), {160, 60}, {160, 140}, {80, 140}}) {
    regions[0].outline.push_back(*painted.view.direction(x, y));
  }
  regions[1].plume_threshold.reset();
  regions[1].spatter_threshold = 1.5 * kHotSpotThreshold;
  regions[2].hot_spot_threshold = 2 * kHotSpotThreshold;
  const auto memory = std::make_shared<SearchMemory>();
  std::vector<RegionMeter> together, alone;
  for (const RegionSettings& region : regions) {
    together.push_back(RegionMeter::make(painted.view, {}, region, nullptr, memory).value());
    alone.push_back(meter_of(painted, region));
  }
  std::mt19937 random(5);
  for (int frame = 0; frame < 20; ++frame) {
    painted.clear();
    painted.paint_hill(*painted.view.direction(60 + 5 * frame, 100), 0.05, 2.5 * kHotSpotThreshold);
    for (int n = 0; n < 2000 * (frame % 3); ++n) {
      painted.at(static_cast<int>(random() % 240), static_cast<int>(random() % 180)) =
          static_cast<std::uint16_t>(random() % 60000);
    }
    for (std::size_t i = 0; i < regions.size(); ++i) {
      const Signals shared = together[i].measure(painted.plane(), painted.seen(), frame / 30.0);
      const Signals own = alone[i].measure(painted.plane(), painted.seen(), frame / 30.0);
      for (const SignalInfo& signal : kSignals) {
        ASSERT_EQ(std::bit_cast<std::uint64_t>(shared.*signal.member),
                  std::bit_cast<std::uint64_t>(own.*signal.member))
            << signal.name << " of region " << i << " in frame " << frame;
      }
    }
  }
  EXPECT_GT(alone[1].untracked_sparks(), 0U);
}

TEST(RegionMeter, EightBitPicturesSaturate) {
  PaintedView painted(kView);
  std::vector<std::uint8_t> bytes(painted.values.size(), 10);
  for (int y = 40; y < 60; ++y) {
    for (int x = 40; x < 60; ++x) bytes[static_cast<std::size_t>(y * 240 + x)] = x < 50 ? 255 : 200;
  }
  RegionSettings region;
  region.hot_spot_threshold = 150;
  region.full_scale = 255;
  RegionMeter meter = meter_of(painted, region);
  const Signals s = meter.measure(ImageView<const std::uint8_t>{bytes.data(), 240, 180, 1, 240},
                                  painted.seen(), 1);
  EXPECT_EQ(s.hot_spot_peak_intensity, 100);
  EXPECT_EQ(s.hot_spot_saturated, 50);
  EXPECT_FALSE(is_valid(s.plume_area)) << "no threshold was given";
  EXPECT_FALSE(is_valid(s.spatter_rate));
}

TEST(RegionMeter, CoolingIsTheFallOfWhatHasLeft) {
  PaintedView painted(kView);
  RegionSettings region = settings();
  region.radiometry.kelvin_per_count = 0.04;
  RegionMeter meter = meter_of(painted, region);
  painted.paint_hill(*painted.view.direction(100, 90), 0.06, kHotSpotThreshold);
  EXPECT_FALSE(is_valid(meter.measure(painted.plane(), painted.seen(), 0).hot_spot_cooling_rate));
  // Everything cools by 500 counts, 20 K, within 1/50 s.
  for (auto& value : painted.values) value = static_cast<std::uint16_t>(std::max(0, value - 500));
  Signals s = meter.measure(painted.plane(), painted.seen(), 0.02);
  EXPECT_NEAR(s.hot_spot_cooling_rate, 1000, 10);
  s = meter.measure(painted.plane(), painted.seen(), 0.04);
  EXPECT_FALSE(is_valid(s.hot_spot_cooling_rate)) << "nothing has left";
  for (auto& value : painted.values) value = static_cast<std::uint16_t>(value / 2);
  s = meter.measure(painted.plane(), painted.seen(), 0.06);
  EXPECT_EQ(s.hot_spot_present, 0);
  EXPECT_GT(s.hot_spot_cooling_rate, 10000) << "all of it has left";
}

TEST(RegionMeter, StatisticsFollowTheMainSignals) {
  PaintedView painted(kView);
  RegionMeter meter = meter_of(painted, settings());
  Signals s;
  for (int i = 0; i < 30; ++i) {
    painted.clear(static_cast<std::uint16_t>(21000 + 10 * i));
    s = meter.measure(painted.plane(), painted.seen(), i / 30.0);
  }
  const double step = 100 * 10 / 65535.0;  // % per frame
  EXPECT_NEAR(s.hot_spot_mean_intensity_trend, 30 * step, 1e-6);
  EXPECT_NEAR(s.hot_spot_mean_intensity_mean, s.hot_spot_mean_intensity - 14.5 * step, 1e-6);
  EXPECT_NEAR(s.hot_spot_mean_intensity_deviation, step * std::sqrt(30 * 31 / 12.0), 1e-6);
  EXPECT_FALSE(is_valid(s.hot_spot_area_mean));
  // A clock that jumps back resets everything.
  s = meter.measure(painted.plane(), painted.seen(), 0);
  EXPECT_EQ(s.hot_spot_mean_intensity_mean, s.hot_spot_mean_intensity);
  EXPECT_FALSE(is_valid(s.hot_spot_mean_intensity_trend));
}

/// The last of several frame sets in which an ellipse on the floor cools and a spark flies past.
Signals measure_process(const RegionSettings& region, const RegionScene& scene) {
  const Vec3 ball = floor_scene().ball.centre, centre{170, 260, -300};
  PaintedView painted({ViewKind::Perspective, {30, -50, 20}, 60, {}, 320, 240});
  RegionMeter meter = meter_of(painted, region, scene);
  Signals signals;
  for (int i = 0; i < 15; ++i) {
    painted.clear();
    painted.paint([&](const Vec3& d) {
      if (d.z >= 0) return 0.0;
      const Vec3 p = ball + d * ((centre.z - ball.z) / d.z) - centre;
      const double a = p.x / 30, b = p.y / 18;
      return (1.5 - 0.01 * i) * kHotSpotThreshold * std::pow(2.0 / 3, a * a + b * b);
    });
    if (i < 7) painted.paint_hill(*painted.view.direction(30 + 10 * i, 40), 0.01, 10000);
    signals = meter.measure(painted.plane(), painted.seen(), 0.02 * i);
  }
  return signals;
}

TEST(RegionMeter, ASignalHasAValueWhenItsRequirementsAreProvidedAndNeverWithoutOne) {
  RegionSettings all = settings();
  all.width_set_point = 20;
  all.radiometry.kelvin_per_count = 0.04;
  const Signals complete = measure_process(all, floor_scene());
  for (const SignalInfo& signal : kSignals) {
    EXPECT_FALSE(first_missing(signal, provided_by(all, true))) << signal.name;
    EXPECT_TRUE(is_valid(complete.*signal.member)) << signal.name;
  }
  for (const Requirement& requirement : kRequirements) {
    RegionSettings region = all;
    if (requirement.flag == Requires::SpatterThreshold) region.spatter_threshold.reset();
    if (requirement.flag == Requires::PlumeThreshold) region.plume_threshold.reset();
    if (requirement.flag == Requires::WidthSetPoint) region.width_set_point.reset();
    if (requirement.flag == Requires::RadiometricCamera) region.radiometry.kelvin_per_count = 0;
    const bool has_scene = requirement.flag != Requires::Scene;
    const Signals signals =
        measure_process(region, has_scene ? floor_scene() : RegionScene{floor_scene().ball, {}});
    for (const SignalInfo& signal : kSignals) {
      const auto missing = first_missing(signal, provided_by(region, has_scene));
      EXPECT_EQ(is_valid(signals.*signal.member), !missing)
          << signal.name << " without " << requirement.text;
      if (missing) {
        EXPECT_EQ(missing->text, requirement.text) << signal.name;
      }
    }
  }
}

TEST(RegionMeter, RefusesWhatCannotBeMeasured) {
  const PaintedView painted(kView);
  const auto refused = [&](auto change) {
    RegionSettings region = settings();
    change(region);
    return !RegionMeter::make(painted.view, {}, region);
  };
  EXPECT_FALSE(refused([](auto&) {}));
  for (const double bad : {0.0, -1.0, 65536.0, static_cast<double>(NAN), HUGE_VAL}) {
    EXPECT_TRUE(refused([&](auto& r) { r.hot_spot_threshold = bad; })) << bad;
    EXPECT_TRUE(refused([&](auto& r) { r.spatter_threshold = bad; })) << bad;
    EXPECT_TRUE(refused([&](auto& r) { r.plume_threshold = bad; })) << bad;
    EXPECT_TRUE(refused([&](auto& r) { r.full_scale = bad; })) << bad;
  }
  EXPECT_TRUE(refused([](auto& r) { r.plume_threshold = kHotSpotThreshold; }));
  EXPECT_TRUE(refused([](auto& r) { r.width_set_point = 0; }));
  EXPECT_TRUE(refused([](auto& r) { r.radiometry.kelvin_per_count = -1; }));
  EXPECT_TRUE(refused([](auto& r) { r.outline = {{0, 1, 0}}; }));
}

TEST(RegionMeter, RefusesLimitsOfTheHotSpotThatHaveNoSurface) {
  const PaintedView painted(kView);
  const auto error = [&](const HotSpotLimits& limits, const RegionScene& scene) {
    RegionSettings region = settings();
    region.hot_spot_limits = limits;
    const auto meter = RegionMeter::make(painted.view, scene, region);
    return meter ? std::string() : meter.error().message;
  };
  EXPECT_EQ(error({}, {}), "");
  EXPECT_EQ(error({20, 30}, floor_scene()), "");
  for (const HotSpotLimits& limits : {HotSpotLimits{20}, HotSpotLimits{0, 30}}) {
    EXPECT_THAT(error(limits, {}), testing::HasSubstr("the rig needs a [scene]"));
  }
  for (const double bad : {-1.0, static_cast<double>(NAN), HUGE_VAL}) {
    EXPECT_THAT(error({bad}, floor_scene()), testing::HasSubstr("least area")) << bad;
  }
  for (const double bad : {-1.0, 0.0, static_cast<double>(NAN)}) {
    EXPECT_THAT(error({0, bad}, floor_scene()), testing::HasSubstr("highest speed")) << bad;
  }
}

}  // namespace
}  // namespace orbwatch::signals
