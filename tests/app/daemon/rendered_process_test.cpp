// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <opencv2/imgcodecs.hpp>
#include <set>

#include "app/pictures/colour_maps.h"
#include "hal/frame/frame_pool.h"
#include "proc/optics/vec.h"
#include "proc/signals/hot_spot/assumed_limits.h"
#include "proc/signals/region_meter.h"
#include "tests/app/daemon/measured_sequence.h"
#include "tests/support/error_distribution.h"
#include "tests/support/pixel_of_point.h"
#include "tests/support/reference_data.h"
#include "tests/support/rendered_scene.h"
#include "tests/support/rendered_sequence.h"

/// Process in reference pictures that are rendered by an independent program.
namespace orbwatch::tests {
namespace {

using optics::Vec3;

Vec3 direction_of(const signals::Signals& s) {
  const double yaw = optics::radians(s.hot_spot_yaw), pitch = optics::radians(s.hot_spot_pitch);
  return {std::cos(pitch) * std::sin(yaw), std::cos(pitch) * std::cos(yaw), std::sin(pitch)};
}

/// Errors over a sequence. The frame's own pixels and scene.json, not the measurement, determine
/// whether the pool is hidden or touched in a frame.
struct Errors {
  ErrorDistribution alone{"direction_deg_pool_alone"};
  ErrorDistribution touched{"direction_deg_spark_beside_pool"};
  int hidden = 0;  ///< frames whose pixel at the pool is cold: the nozzle is in front of it
  std::set<int> sparks;
  double counted = 0;
};

Errors measure_all(MeasuredSequence& measured, const RenderedSequence& sequence, double threshold) {
  constexpr double kBeside = 5;  // degrees
  const Vec3 ball = sequence.scene().ball.centre;
  Errors errors;
  for (std::size_t i = 0; i < sequence.frames().size(); ++i) {
    const RenderedSequence::Frame& frame = sequence.frames()[i];
    const signals::Signals s = measured.measure(i);
    errors.counted = s.spatter_rate;  // the frames last one second
    const auto angle_to_pool = [&](const Vec3& direction) {
      return optics::degrees(optics::angle_between(direction, frame.melt - ball));
    };
    bool beside = false;
    for (const auto& spark : frame.sparks) {
      errors.sparks.insert(spark.id);
      beside = beside || angle_to_pool(spark.position - ball) < kBeside;
    }
    if (measured.counts_at(pixel_of_point(sequence.camera(), frame.melt).value()) < threshold) {
      ++errors.hidden;
      continue;
    }
    EXPECT_EQ(s.hot_spot_present, 1) << "frame " << i;
    (beside ? errors.touched : errors.alone).add(angle_to_pool(direction_of(s)));
  }
  errors.alone.report();
  errors.touched.report();
  std::printf("pool hidden in %d frames; %zu sparks, counted %.0f\n", errors.hidden,
              errors.sparks.size(), errors.counted);
  return errors;
}

TEST(RenderedProcess, ThermalCameraFindsThePool) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures() / "scene.json");
  const RenderedSequence sequence("seq_thermal");
  signals::RegionSettings region;
  region.radiometry.kelvin_per_count = 0.04;
  region.hot_spot_threshold = (450 + 273.15) / 0.04;
  region.spatter_threshold = (300 + 273.15) / 0.04;
  MeasuredSequence measured(sequence, PixelFormat::Y16, region);
  const Errors errors = measure_all(measured, sequence, region.hot_spot_threshold);
  EXPECT_GE(errors.alone.size(), 6U);
  EXPECT_LE(errors.alone.max(), 0.3);
  EXPECT_LE(errors.touched.p50(), 0.6);
  // The camera has a pixel per degree there: a spark covers a pixel or two.
  EXPECT_NEAR(errors.counted, static_cast<double>(errors.sparks.size()), 7);
}

/// Errors of the pool's place, mm, for a region without limits on sparks other than `limits`; there
/// must be no report while the nozzle hides the pool.
ErrorDistribution errors_with(const RenderedSequence& sequence,
                              const signals::HotSpotLimits& limits) {
  signals::RegionSettings region;
  region.radiometry.kelvin_per_count = 0.04;
  region.hot_spot_threshold = (700 + 273.15) / 0.04;
  region.hot_spot_limits = limits;
  MeasuredSequence measured(sequence, PixelFormat::Y16, region);
  ErrorDistribution errors("position_mm");
  for (std::size_t i = 0; i < sequence.frames().size(); ++i) {
    const Vec3& melt = sequence.frames()[i].melt;
    const signals::Signals s = measured.measure(i);
    const double here = measured.counts_at(pixel_of_point(sequence.camera(), melt).value());
    if (here < region.hot_spot_threshold) {
      EXPECT_EQ(s.hot_spot_present, 0) << "frame " << i;
      EXPECT_FALSE(signals::is_valid(s.hot_spot_width)) << "frame " << i;
      EXPECT_FALSE(signals::is_valid(s.hot_spot_confidence)) << "frame " << i;
    }
    if (s.hot_spot_present == 0) continue;
    errors.add(optics::norm(Vec3{s.hot_spot_x, s.hot_spot_y, s.hot_spot_z} - melt));
  }
  errors.report();
  return errors;
}

TEST(RenderedProcess, NoSparkIsThePoolWhileTheNozzleHidesIt) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures() / "scene.json");
  const auto errors =
      errors_with(RenderedSequence("seq_thermal"), {.min_area = 60, .max_speed = 1000});
  EXPECT_GE(errors.size(), 17U);
  EXPECT_LE(errors.max(), 5);
}

TEST(RenderedProcess, NoSparkIsThePoolByWhatIsAssumedOfIt) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures() / "scene.json");
  const RenderedSequence sequence("seq_thermal");
  const auto errors = errors_with(
      sequence,
      signals::assumed_limits(process_view(), sequence.scene(), {}, sequence.frame_rate()));
  EXPECT_GE(errors.size(), 17U);
  EXPECT_LE(errors.max(), 8) << "sparks smaller than stated ones touch the pool";
}

TEST(RenderedProcess, ColourCameraFindsThePool) {
  ORBWATCH_REQUIRE_FILE(rendered_pictures() / "scene.json");
  const RenderedSequence sequence("seq_spark");
  signals::RegionSettings region;
  region.full_scale = 255;
  region.hot_spot_threshold = 235;
  // Corners of the workpiece's top: walls have letters as bright as the pool.
  for (const Vec3& corner :
       {Vec3{-190, -130, 178}, {-30, -130, 178}, {-30, 30, 178}, {-190, 30, 178}}) {
    region.outline.push_back(corner - sequence.scene().ball.centre);
  }
  MeasuredSequence measured(sequence, PixelFormat::Grey, region);
  const Errors errors = measure_all(measured, sequence, region.hot_spot_threshold);
  EXPECT_GE(errors.alone.size(), 6U);
  EXPECT_LE(errors.alone.max(), 0.3);
  EXPECT_LE(errors.touched.p50(), 0.6);
}

}  // namespace
}  // namespace orbwatch::tests
