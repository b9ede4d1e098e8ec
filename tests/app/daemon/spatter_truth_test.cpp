// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>

#include "app/simulation/scene/process.h"
#include "proc/optics/vec.h"
#include "tests/app/daemon/measured_machine.h"

/// Compares measured sparks with those of the simulated machine.
namespace orbwatch::app::daemon {
namespace {

using optics::Vec3;
using simulation::MachineSettings;
using simulation::Spark;

/// Sparks in the air in any frame set, and their speed from the ball's view.
class SparkTruth {
 public:
  explicit SparkTruth(const MachineSettings& settings) : settings_(settings) {}

  void add(double seconds) {
    const simulation::ProcessTruth process = simulation::process_at(settings_, seconds);
    for (const Spark& spark : process.sparks()) {
      const Vec3 direction = optics::normalized(spark.position - settings_.ball.centre);
      // A spark keeps its random radius, which identifies it.
      const auto [place, is_new] = flights_.try_emplace(spark.radius);
      Flight& flight = place->second;
      if (is_new) {
        flight.begin = seconds;
      } else {
        flight.path += optics::degrees(optics::angle_between(flight.direction, direction));
      }
      flight.direction = direction;
      flight.end = seconds;
    }
  }

  double count() const { return static_cast<double>(flights_.size()); }
  double mean_speed() const {
    double sum = 0, sparks = 0;
    for (const auto& [radius, flight] : flights_) {
      if (flight.end <= flight.begin) continue;
      sum += flight.path / (flight.end - flight.begin);
      ++sparks;
    }
    return sum / sparks;
  }

 private:
  struct Flight {
    double begin = 0, end = 0;  // s
    double path = 0;            // degrees
    Vec3 direction;
  };

  const MachineSettings& settings_;
  std::map<double, Flight> flights_;
};

struct Case {
  double frame_rate;
  double sparks;     // sparks per second
  double tolerance;  // tolerance of their count, percent
  friend void PrintTo(const Case& c, std::ostream* out) {
    *out << c.sparks << " sparks per second at " << c.frame_rate << " frames per second";
  }
};

class SpatterTruth : public testing::TestWithParam<Case> {};

TEST_P(SpatterTruth, EverySparkCountsOnceAndHasItsSpeed) {
  constexpr double kBegin = 20;  // s
  constexpr int kSeconds = 3;
  MachineSettings settings;
  settings.sparks.rate = GetParam().sparks;
  settings.pool.radius = 5;
  signals::RegionSettings region;
  region.hot_spot_threshold = counts(settings.pool.melting_point);
  region.spatter_threshold = counts(700);  // below the coldest spark
  region.radiometry.kelvin_per_count = kKelvinPerCount;
  MeasuredMachine machine(
      settings, simulation::look_at({49.4, 395.4, 500.6}, settings.ball.centre, 22.5, 640, 512),
      {optics::ViewKind::Perspective, {-115, -30, 0}, 130, {}, 480, 360}, region);
  SparkTruth truth(settings);
  const auto frames = static_cast<int>(GetParam().frame_rate);
  double counted = 0, speed = 0, binned = 0, ended = 0;
  for (int second = 0; second < kSeconds; ++second) {
    signals::Signals last;
    for (int frame = 1; frame <= frames; ++frame) {
      const double time = kBegin + second + frame / GetParam().frame_rate;
      truth.add(time);
      last = machine.measure(time);
    }
    counted += last.spatter_rate;
    const double here = last.spatter_speed_0 + last.spatter_speed_50 + last.spatter_speed_100 +
                        last.spatter_speed_150 + last.spatter_speed_200 + last.spatter_speed_250 +
                        last.spatter_speed_300 + last.spatter_speed_350;
    speed += here * last.spatter_speed;
    ended += here;
    binned += here > 0 && last.spatter_speed > 0 ? 1 : 0;
  }
  const double mean_speed = speed / ended;
  char line[160];
  std::snprintf(line, sizeof line,
                "%.0f sparks, counted %.0f; mean speed %.0f deg/s, measured %.0f", truth.count(),
                counted, truth.mean_speed(), mean_speed);
  std::puts(line);
  RecordProperty("spatter", line);
  EXPECT_NEAR(counted, truth.count(), std::max(2.0, truth.count() * GetParam().tolerance / 100));
  EXPECT_EQ(binned, kSeconds);
  EXPECT_NEAR(mean_speed, truth.mean_speed(), 0.35 * truth.mean_speed());
  EXPECT_EQ(machine.meter().untracked_sparks(), 0U);
}

// At 15 frames per second sparks move up to 20 degrees between frames and are seen two to five
// times: among many of them some are confused with others.
INSTANTIATE_TEST_SUITE_P(Cases, SpatterTruth,
                         testing::Values(Case{15, 10, 30}, Case{15, 60, 30}, Case{30, 10, 15},
                                         Case{30, 60, 15}, Case{60, 10, 15}, Case{60, 60, 15}));

TEST(Spatter, NoSparksNoSpatter) {
  MachineSettings settings;
  settings.sparks.rate = 0;
  signals::RegionSettings region;
  region.hot_spot_threshold = counts(settings.pool.melting_point);
  region.spatter_threshold = counts(700);
  MeasuredMachine machine(
      settings, simulation::look_at({49.4, 395.4, 500.6}, settings.ball.centre, 22.5, 320, 256),
      {optics::ViewKind::Perspective, {-115, -30, 0}, 130, {}, 320, 240}, region);
  for (int frame = 0; frame < 15; ++frame) {
    const signals::Signals s = machine.measure(frame / 15.0);
    EXPECT_EQ(s.spatter_count, 0);
    EXPECT_EQ(s.spatter_rate, 0);
    EXPECT_FALSE(signals::is_valid(s.spatter_speed));
  }
}

}  // namespace
}  // namespace orbwatch::app::daemon
