// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "app/simulation/scene/process.h"
#include "proc/optics/resolution.h"
#include "proc/optics/vec.h"
#include "proc/signals/hot_spot/principal_axes.h"
#include "tests/app/daemon/measured_machine.h"
#include "tests/support/error_distribution.h"
#include "tests/support/pixel_of_point.h"
#include "tests/support/share.h"

/// Compares measurements of the melt pool with the simulated machine's truth, over random scenes:
/// pool, ball, camera, view and region.
namespace orbwatch::app::daemon {
namespace {

using optics::Vec3;
using simulation::MachineSettings;
using simulation::MeltPool;
using tests::ErrorDistribution;

double longitude(const Vec3& d) { return optics::degrees(std::atan2(d.x, d.y)); }
double latitude(const Vec3& d) { return optics::degrees(std::asin(d.z / optics::norm(d))); }

/// Pool out to `radius` from the view of the ball's centre, by summing over rings of the disc.
struct SeenDisc {
  double solid_angle = 0;
  Vec3 direction;
  signals::PrincipalAxes axes;
  double mean_celsius = 0;

  SeenDisc(const MeltPool& pool, double radius, const Vec3& from) {
    constexpr int kRings = 60, kSectors = 120;
    Vec3 first;
    signals::Symmetric3 second;
    for (int i = 0; i < kRings; ++i) {
      const double r = radius * (i + 0.5) / kRings;
      for (int j = 0; j < kSectors; ++j) {
        const double angle = 2 * std::numbers::pi * (j + 0.5) / kSectors;
        const Vec3 sight = pool.centre + Vec3{r * std::cos(angle), r * std::sin(angle), 0} - from;
        const double distance = optics::norm(sight);
        const double mm2 = r * radius / kRings * 2 * std::numbers::pi / kSectors;
        const double omega = mm2 * std::abs(sight.z) / std::pow(distance, 3);
        const Vec3 d = sight * (1 / distance);
        solid_angle += omega;
        mean_celsius += omega * pool.temperature_at(r);
        first = first + d * omega;
        second.add(d, omega);
      }
    }
    mean_celsius /= solid_angle;
    const Vec3 mean = first * (1 / solid_angle);
    second.add(mean, -solid_angle);
    const double s = 1 / solid_angle;
    axes = signals::principal_axes(
        {second.xx * s, second.yy * s, second.zz * s, second.xy * s, second.xz * s, second.yz * s});
    direction = optics::normalized(mean);
  }
};

/// Mean cooling rate of surface points that were molten and no longer are.
double cooling_rate(const MeltPool& before, const MeltPool& after, double passed) {
  const double step = before.radius / 200;
  double fall = 0, points = 0;
  for (double x = -1.1 * before.radius; x < 1.1 * before.radius; x += step) {
    for (double y = -1.1 * before.radius; y < 1.1 * before.radius; y += step) {
      const Vec3 p = before.centre + Vec3{x, y, 0};
      const double r0 = optics::norm(p - before.centre), r1 = optics::norm(p - after.centre);
      if (r0 >= before.radius || r1 < after.radius) continue;
      fall += before.temperature_at(r0) - after.temperature_at(r1);
      ++points;
    }
  }
  return fall / points / passed;
}

constexpr double kPlume = 900;  // degC

double radius_at(const MeltPool& pool, double celsius) {
  const double excess = pool.peak - pool.ambient;
  return pool.radius * std::sqrt(std::log(excess / (celsius - pool.ambient)) /
                                 std::log(excess / (pool.melting_point - pool.ambient)));
}

/// Random machine, camera and region, with the pool's radius over `pixels` pixels of the camera at
/// its worst resolution.
class Scene {
 public:
  Scene(std::mt19937& random, double pixels) : random_(random) {
    settings.seed = random_();
    settings.sparks.rate = 0;
    settings.pool.radius = std::exp(draw(std::log(1.3), std::log(16)));  // 1 to 20 with its swing
    settings.pool.path_x = draw(-125, -95);
    settings.pool.path_y = draw(-65, -35);
    settings.pool.path_radius = draw(2, 10);
    settings.pool.lap_time = draw(1, 6);
    settings.pool.peak = draw(1700, 2150);  // below full scale, 2348, with its swing
    settings.nozzle.standoff = 70;          // hides no part of the largest pool
    settings.ball.centre = {draw(80, 160), draw(20, 100), draw(380, 480)};
    seconds = draw(0, 60);
    const MeltPool pool = simulation::process_at(settings, seconds).pool;
    const Vec3 to_pool = optics::normalized(pool.centre - settings.ball.centre);
    pinhole = draw_camera(pool, to_pool);
    const auto centre =
        tests::pixel_of_point(projection_of(pinhole, region_scene_of(settings)), pool.centre)
            .value();
    pinhole = simulation::look_at(
        pinhole.position, pinhole.position + pinhole.ray_through(centre.u, centre.v).direction, 10,
        256, 256);
    const SeenDisc disc(pool, pool.radius, settings.ball.centre);
    const double narrow = optics::degrees(2 * std::sqrt(disc.axes.second));
    const double resolution =
        optics::resolution(projection_of(pinhole, region_scene_of(settings)), to_pool);
    pinhole.focal_length *= pixels / (narrow * resolution);
    // The view has the camera's resolution, or up to twice as much.
    const double per_degree = pixels / narrow * draw(1, 2);
    const double wide = optics::degrees(2 * std::sqrt(disc.axes.largest)) * 2.2;
    const int side = static_cast<int>(2 * wide * per_degree) + 8;
    view = {optics::ViewKind::Perspective,
            {longitude(to_pool) + draw(-0.1, 0.1) * wide, latitude(to_pool), draw(-180, 180)},
            side / per_degree,
            {},
            side,
            side};
    region.hot_spot_threshold = counts(settings.pool.melting_point);
    region.plume_threshold = counts(kPlume);
    region.radiometry.kelvin_per_count = kKelvinPerCount;
    region.width_set_point = 10;
    if (draw(0, 1) < 0.5) draw_outline(pool);
  }

  MeasuredMachine machine() const { return {settings, pinhole, view, region}; }
  Vec3 ball() const { return settings.ball.centre; }

  MachineSettings settings;
  simulation::Pinhole pinhole;
  optics::ViewSpec view;
  signals::RegionSettings region;
  double seconds = 0;

 private:
  double draw(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  /// Camera in the enclosure that looks at the reflection of the pool in the ball, by reflection
  /// under at most 55 degrees, past the nozzle's column.
  simulation::Pinhole draw_camera(const MeltPool& pool, const Vec3& to_pool) {
    const simulation::Sphere& ball = settings.ball;
    std::normal_distribution<double> normal;
    for (;;) {
      const Vec3 d = optics::normalized({normal(random_), normal(random_), normal(random_)});
      const Vec3 position = ball.centre + d * draw(5, 7) * ball.radius;
      const Vec3 mirror = ball.centre + optics::normalized(d + to_pool) * ball.radius;
      if (!settings.enclosure.contains(position) || position.z < ball.centre.z ||
          optics::angle_between(d, to_pool) > optics::radians(110)) {
        continue;
      }
      double clearance = HUGE_VAL;  // distance of the sight from the nozzle's axis
      for (double share = 0; share <= 1; share += 0.02) {
        const Vec3 p = position + (mirror - position) * share - pool.centre;
        clearance = std::min(clearance, std::hypot(p.x, p.y));
      }
      if (clearance > 2 * settings.nozzle.column_radius) {
        return simulation::look_at(position, mirror, 10, 256, 256);
      }
    }
  }

  /// Draws a hexagon of machine points around the pool and its plume.
  void draw_outline(const MeltPool& pool) {
    const double out = 1.3 * radius_at(pool, kPlume);
    const double turn = draw(0, 1);
    for (int i = 0; i < 6; ++i) {
      const double angle = turn + i * std::numbers::pi / 3;
      region.outline.push_back(pool.centre + Vec3{out * std::cos(angle), out * std::sin(angle), 0} -
                               settings.ball.centre);
    }
  }

  std::mt19937& random_;
};

/// Errors of every figure of the pool, relative ones in percent.
struct PoolErrors {
  explicit PoolErrors(const std::string& prefix)
      : area(prefix + "area_mm2_percent"),
        solid_angle(prefix + "solid_angle_percent"),
        plume(prefix + "plume_percent"),
        length(prefix + "length_percent"),
        width(prefix + "width_percent"),
        length_angle(prefix + "length_angle_percent"),
        width_angle(prefix + "width_angle_percent"),
        orientation(prefix + "orientation_deg"),
        direction(prefix + "direction_deg"),
        position(prefix + "position_percent_of_radius"),
        peak(prefix + "peak_K"),
        mean(prefix + "mean_K"),
        cooling(prefix + "cooling_percent") {}

  template <class Spoil>
  void add(const Scene& scene, MeasuredMachine& machine, const Spoil& spoil) {
    constexpr double kFrame = 1.0 / 30;
    const MeltPool before = simulation::process_at(scene.settings, scene.seconds - kFrame).pool;
    const MeltPool pool = simulation::process_at(scene.settings, scene.seconds).pool;
    machine.measure(scene.seconds - kFrame, spoil);
    const signals::Signals s = machine.measure(scene.seconds, spoil);
    const SeenDisc disc(pool, pool.radius, scene.ball());
    const SeenDisc halo(pool, radius_at(pool, kPlume), scene.ball());
    const auto percent = [](double value, double truth) { return 100 * (value / truth - 1); };
    area.add(percent(s.hot_spot_area, std::numbers::pi * pool.radius * pool.radius));
    solid_angle.add(percent(s.hot_spot_solid_angle, 1000 * disc.solid_angle));
    plume.add(percent(s.plume_area, 1000 * (halo.solid_angle - disc.solid_angle)));
    length.add(percent(s.hot_spot_length, 2 * pool.radius));
    width.add(percent(s.hot_spot_width, 2 * pool.radius));
    const auto axis = [](double variance) {
      return optics::degrees(2 * std::asin(2 * std::sqrt(variance)));
    };
    length_angle.add(percent(s.hot_spot_length_angle, axis(disc.axes.largest)));
    width_angle.add(percent(s.hot_spot_width_angle, axis(disc.axes.second)));
    add_orientation(s, disc);
    const double yaw = optics::radians(s.hot_spot_yaw), pitch = optics::radians(s.hot_spot_pitch);
    const Vec3 measured{std::cos(pitch) * std::sin(yaw), std::cos(pitch) * std::cos(yaw),
                        std::sin(pitch)};
    direction.add(optics::degrees(optics::angle_between(measured, disc.direction)));
    const Vec3 place{s.hot_spot_x, s.hot_spot_y, s.hot_spot_z};
    position.add(100 * optics::norm(place - pool.centre) / pool.radius);
    peak.add(s.hot_spot_peak_temperature - pool.peak);
    mean.add(s.hot_spot_mean_temperature - disc.mean_celsius);
    cooling.add(percent(s.hot_spot_cooling_rate, cooling_rate(before, pool, kFrame)));
  }

  void add_orientation(const signals::Signals& s, const SeenDisc& disc) {
    const Vec3& d = disc.direction;
    const Vec3 right = optics::normalized({d.y, -d.x, 0});
    const double up = optics::dot(disc.axes.axis, optics::cross(right, d));
    const double truth = optics::degrees(std::atan2(up, optics::dot(disc.axes.axis, right)));
    if (disc.axes.largest < 1.2 * disc.axes.second) return;  // noise dominates for a round one
    orientation.add(std::remainder(s.hot_spot_orientation - truth, 180));
  }

  void report() const {
    for (const auto* errors :
         {&area, &solid_angle, &plume, &length, &width, &length_angle, &width_angle, &orientation,
          &direction, &position, &peak, &mean, &cooling}) {
      errors->report();
    }
  }

  ErrorDistribution area, solid_angle, plume, length, width, length_angle, width_angle, orientation,
      direction, position, peak, mean, cooling;
};

/// Checks the tolerances, for pools with a radius of at least four of the camera's pixels.
void expect_tolerances(const PoolErrors& errors) {
  constexpr double kRange = kKelvinPerCount * 65535;  // K
  EXPECT_LE(errors.area.max(), 3);
  EXPECT_LE(errors.solid_angle.max(), 3);
  EXPECT_LE(errors.plume.max(), 3);
  EXPECT_LE(errors.length.max(), 2);
  EXPECT_LE(errors.width.max(), 2);
  EXPECT_LE(errors.length_angle.max(), 2);
  EXPECT_LE(errors.width_angle.max(), 2);
  EXPECT_LE(errors.orientation.max(), 1);
  EXPECT_LE(errors.direction.max(), 0.3);
  EXPECT_LE(errors.position.max(), 1);
  EXPECT_LE(errors.peak.max(), 0.01 * kRange);
  EXPECT_LE(errors.mean.max(), 0.01 * kRange);
  EXPECT_LE(errors.cooling.max(), 10);
}

class PoolTruth : public testing::TestWithParam<int> {};

TEST_P(PoolTruth, WithoutNoiseEveryFigureIsWithinItsTolerance) {
  const int pixels = GetParam();
  std::mt19937 random(static_cast<unsigned>(pixels));
  PoolErrors errors("radius_" + std::to_string(pixels) + "px_");
  for (int n = orbwatch::tests::share_of(16); n > 0; --n) {
    const Scene scene(random, pixels);
    MeasuredMachine machine = scene.machine();
    errors.add(scene, machine, [](const ImageView<std::uint16_t>&) {});
  }
  errors.report();
  EXPECT_LE(errors.direction.max(), 0.3);
  if (pixels >= 4) expect_tolerances(errors);
}

INSTANTIATE_TEST_SUITE_P(Pixels, PoolTruth, testing::Values(1, 2, 3, 4, 6, 10));

TEST(PoolWithNoise, OfAPercentOfTheRangeIsStillMeasured) {
  constexpr double kNoise = 0.01 * 65535;  // counts, standard deviation: far above any camera's
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, kNoise);
  PoolErrors errors("noise_1_percent_radius_6px_");
  for (int n = orbwatch::tests::share_of(16); n > 0; --n) {
    const Scene scene(random, 6);
    MeasuredMachine machine = scene.machine();
    errors.add(scene, machine, [&](const ImageView<std::uint16_t>& picture) {
      for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
          std::uint16_t& count = *picture.at(x, y);
          count = static_cast<std::uint16_t>(std::clamp(count + noise(random), 0.0, 65535.0));
        }
      }
    });
  }
  errors.report();
  EXPECT_LE(errors.area.p95(), 3);
  EXPECT_LE(errors.direction.max(), 0.3);
  EXPECT_LE(errors.mean.max(), 0.01 * kKelvinPerCount * 65535);
}

}  // namespace
}  // namespace orbwatch::app::daemon
