// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>

#include "app/simulation/scene/nozzle.h"
#include "app/simulation/scene/process.h"
#include "app/simulation/scene/static_scene.h"
#include "tests/app/daemon/measured_machine.h"
#include "tests/support/error_distribution.h"
#include "tests/support/pixel_of_point.h"
#include "tests/support/share.h"

/// Reports while the nozzle hides the melt pool of the simulated machine for a part of each lap and
/// sparks of the same temperature fly: random scenes.
namespace orbwatch::app::daemon {
namespace {

using optics::Vec3;
using simulation::MachineSettings;
using simulation::MeltPool;
using tests::ErrorDistribution;

constexpr double kFrameRate = 30;
constexpr double kThreshold = 1200;  // degC; sparks are always hotter

/// Process with a wide and low nozzle: it is between pool and ball for about half a lap.
class HiddenScene {
 public:
  explicit HiddenScene(std::mt19937& random) {
    const auto draw = [&](double low, double high) {
      return std::uniform_real_distribution<double>(low, high)(random);
    };
    settings.seed = random();
    settings.pool.radius = draw(5, 10);
    settings.pool.lap_time = draw(4, 8);
    settings.nozzle.standoff = draw(30, 50);
    settings.nozzle.cone_height = draw(40, 60);
    // The ball's centre is 41 to 50 degrees above the pool.
    settings.nozzle.column_radius =
        draw(0.95, 1.05) * (settings.nozzle.standoff + settings.nozzle.cone_height);
  }

  signals::RegionSettings region() const {
    signals::RegionSettings region;
    region.hot_spot_threshold = counts(kThreshold);
    region.radiometry.kelvin_per_count = kKelvinPerCount;
    return region;
  }
  signals::RegionSettings limited_region() const {
    const double radius = settings.pool.radius * (1 - settings.pool.radius_swing);
    signals::RegionSettings limited = region();
    limited.hot_spot_limits.min_area = 0.5 * std::numbers::pi * radius * radius;
    limited.hot_spot_limits.max_speed =
        1.5 * 2 * std::numbers::pi * settings.pool.path_radius / settings.pool.lap_time;
    return limited;
  }

  /// Share of the molten pool that the camera sees in the ball past the nozzle.
  double visible_share(double seconds) const {
    constexpr int kRings = 4, kSectors = 12;
    const simulation::ProcessTruth process = simulation::process_at(settings, seconds);
    const MeltPool& pool = process.pool;
    const simulation::Nozzle nozzle(settings.nozzle, process.nozzle_tip, settings.enclosure.hi.z);
    int visible = 0;
    for (int i = 0; i < kRings * kSectors; ++i) {
      const double radius = pool.radius * std::sqrt((i / kSectors + 0.5) / kRings);
      const double angle = 2 * std::numbers::pi * i / kSectors;
      const Vec3 point = pool.centre + Vec3{radius * std::cos(angle), radius * std::sin(angle), 0};
      const auto pixel = tests::pixel_of_point(projection, point).value();
      const simulation::Sight sight =
          simulation::sight_along(pinhole.ray_through(pixel.u, pixel.v), settings.ball);
      const double distance = optics::norm(point - sight.mirrored.origin);
      const bool hidden = nozzle.entry(sight.direct) < sight.ball_distance ||
                          nozzle.entry(sight.mirrored) < distance;
      visible += hidden ? 0 : 1;
    }
    return visible / static_cast<double>(kRings * kSectors);
  }

  /// First moment at which all of the pool is in view, s: before it there is no information.
  double comes_into_view() const {
    double seconds = 20;
    while (visible_share(seconds) < 1) seconds += 1 / kFrameRate;
    return seconds;
  }

  MachineSettings settings;
  simulation::Pinhole pinhole =
      simulation::look_at({49.4, 395.4, 500.6}, settings.ball.centre, 22.5, 640, 512);
  optics::BallProjection projection = projection_of(pinhole, region_scene_of(settings));
  optics::ViewSpec view{optics::ViewKind::Perspective, {-115, -35, 0}, 100, {}, 480, 360};
};

/// Reports over many laps. Doubt: 100 % minus the confidence, separately for reports that are right
/// to a radius and for the others.
struct Reports {
  explicit Reports(const std::string& prefix)
      : error(prefix + "error_mm"),
        error_in_view(prefix + "error_mm_all_in_view"),
        doubt_right(prefix + "doubt_percent_right"),
        doubt_wrong(prefix + "doubt_percent_wrong") {}

  void add(const signals::Signals& s, const MeltPool& pool, double visible_share) {
    const bool present = s.hot_spot_present > 0;
    const bool in_view = visible_share == 1, hidden = visible_share == 0;
    frames_in_view += in_view ? 1 : 0;
    frames_hidden += hidden ? 1 : 0;
    reported_in_view += in_view && present ? 1 : 0;
    reported_hidden += hidden && present ? 1 : 0;
    if (!present) return;
    const double off = optics::norm(Vec3{s.hot_spot_x, s.hot_spot_y, s.hot_spot_z} - pool.centre);
    error.add(off);
    if (in_view) error_in_view.add(off);
    (off > pool.radius ? doubt_wrong : doubt_right).add(100 - s.hot_spot_confidence);
  }

  double share_in_view() const { return reported_in_view / frames_in_view; }
  double share_hidden() const { return reported_hidden / frames_hidden; }

  void report() const {
    for (const auto* errors : {&error, &error_in_view, &doubt_right, &doubt_wrong}) {
      errors->report();
    }
    char line[160];
    std::snprintf(line, sizeof line,
                  "reported in %.1f %% of %.0f frames with all of it in view, in %.1f %% of %.0f "
                  "with nothing of it",
                  100 * share_in_view(), frames_in_view, 100 * share_hidden(), frames_hidden);
    std::puts(line);
    testing::Test::RecordProperty("reported", line);
  }

  ErrorDistribution error, error_in_view, doubt_right, doubt_wrong;
  double frames_in_view = 0, frames_hidden = 0, reported_in_view = 0, reported_hidden = 0;
};

TEST(HiddenPool, IsNotReportedAndNoSparkIsTakenForIt) {
  std::mt19937 random(3);
  Reports limited("limits_"), unlimited("no_limits_");
  for (int n = tests::share_of(20); n > 0; --n) {
    const HiddenScene scene(random);
    MeasuredMachine machine(scene.settings, scene.pinhole, scene.view, scene.limited_region());
    MeasuredMachine plain(scene.settings, scene.pinhole, scene.view, scene.region());
    const double begin = scene.comes_into_view();
    const int frames = static_cast<int>(scene.settings.pool.lap_time * kFrameRate);
    for (int frame = 0; frame < frames; ++frame) {
      const double seconds = begin + frame / kFrameRate;
      const MeltPool pool = simulation::process_at(scene.settings, seconds).pool;
      const double visible_share = scene.visible_share(seconds);
      limited.add(machine.measure(seconds), pool, visible_share);
      unlimited.add(plain.measure(seconds), pool, visible_share);
    }
  }
  unlimited.report();
  limited.report();
  EXPECT_GE(unlimited.share_hidden(), 0.5) << "what would be taken for it";
  EXPECT_LE(limited.share_hidden(), 0.02);
  EXPECT_GE(limited.share_in_view(), 0.95);
  EXPECT_LE(limited.error.p95(), 8);
  EXPECT_LE(limited.error_in_view.max(), 12) << "a spark that touches it";
  EXPECT_LE(limited.doubt_right.p50(), 0.8 * unlimited.doubt_wrong.p50());
}

}  // namespace
}  // namespace orbwatch::app::daemon
