// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/scene/process.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace orbwatch::app::simulation {
namespace {

TEST(MeltPool, RunsOnAClosedPathUnderTheNozzle) {
  const MachineSettings settings;
  const Vec3 middle{settings.pool.path_x, settings.pool.path_y, settings.workpiece.hi.z};
  for (double t = 0; t < 12; t += 0.37) {
    const ProcessTruth now = process_at(settings, t);
    EXPECT_NEAR(norm(now.pool.centre - middle), settings.pool.path_radius, 1e-9);
    EXPECT_NEAR(norm(now.pool.centre - process_at(settings, t + 12).pool.centre), 0, 1e-9);
    EXPECT_EQ(now.nozzle_tip.x, now.pool.centre.x);
    EXPECT_EQ(now.nozzle_tip.y, now.pool.centre.y);
    EXPECT_NEAR(now.nozzle_tip.z - now.pool.centre.z, settings.nozzle.standoff, 1e-9);
  }
}

TEST(MeltPool, KeepsItsSizeAndPeakWithinTheirSwing) {
  const MachineSettings settings;
  double smallest = 1e9, largest = 0, coolest = 1e9, hottest = 0;
  for (double t = 0; t < 80; t += 0.05) {
    const MeltPool pool = process_at(settings, t).pool;
    smallest = std::min(smallest, pool.radius);
    largest = std::max(largest, pool.radius);
    coolest = std::min(coolest, pool.peak);
    hottest = std::max(hottest, pool.peak);
  }
  EXPECT_NEAR(smallest, 7.5, 0.01);
  EXPECT_NEAR(largest, 12.5, 0.01);
  EXPECT_NEAR(coolest, 1850, 0.5);
  EXPECT_NEAR(hottest, 2150, 0.5);
}

TEST(MeltPool, CoolsFromPeakOverMeltingPointToAmbient) {
  const MeltPool pool = process_at({}, 2.5).pool;
  EXPECT_DOUBLE_EQ(pool.temperature_at(0), pool.peak);
  EXPECT_NEAR(pool.temperature_at(pool.radius), pool.melting_point, 1e-9);
  double before = pool.peak + 1;
  for (double r = 0; r < pool.reach; r += 0.5) {
    EXPECT_LT(pool.temperature_at(r), before);
    before = pool.temperature_at(r);
  }
  EXPECT_LT(pool.temperature_at(pool.reach * 0.999) - pool.ambient, 0.02);
  EXPECT_EQ(pool.temperature_at(pool.reach), pool.ambient);
  // A Gaussian: the logarithm of the excess falls with the square of the distance.
  const auto log_excess = [&](double r) { return std::log(pool.temperature_at(r) - pool.ambient); };
  EXPECT_NEAR((log_excess(0) - log_excess(10)) / (log_excess(0) - log_excess(5)), 4, 1e-9);
}

/// Finds a spark by its radius, which is random and identifies it.
const Spark* find(const ProcessTruth& truth, double radius) {
  for (const Spark& spark : truth.sparks()) {
    if (spark.radius == radius) return &spark;
  }
  return nullptr;
}

TEST(Sparks, FallFreelyAndCool) {
  const MachineSettings settings;
  constexpr double kStep = 0.005;
  int followed = 0;
  for (double t = 1; t < 3; t += 0.05) {
    const ProcessTruth before = process_at(settings, t - kStep);
    const ProcessTruth now = process_at(settings, t);
    const ProcessTruth after = process_at(settings, t + kStep);
    for (const Spark& spark : now.sparks()) {
      const Spark* const earlier = find(before, spark.radius);
      const Spark* const later = find(after, spark.radius);
      if (!earlier || !later) continue;
      ++followed;
      const Vec3 acceleration =
          (later->position - spark.position * 2 + earlier->position) * (1 / (kStep * kStep));
      EXPECT_NEAR(norm(acceleration - Vec3{0, 0, -9810}), 0, 1e-3);
      EXPECT_LT(later->temperature, spark.temperature);
      EXPECT_GE(spark.temperature, settings.sparks.end_temperature);
      EXPECT_LE(spark.temperature, settings.sparks.temperature.hi);
    }
  }
  EXPECT_GT(followed, 100);
}

TEST(Sparks, LeaveThePoolUpwards) {
  const MachineSettings settings;
  std::set<double> known;
  int born = 0;
  constexpr double kStep = 0.0005;
  for (double t = 5; t < 7; t += kStep) {
    const ProcessTruth now = process_at(settings, t);
    for (const Spark& spark : now.sparks()) {
      if (!known.insert(spark.radius).second || t < 5.4) continue;
      ++born;
      const Vec3 away = spark.position - now.pool.centre;
      EXPECT_LT(norm(away), settings.sparks.speed.hi * kStep * 1.1);
      EXPECT_GE(away.z, 0);
    }
  }
  EXPECT_NEAR(born, 1.6 * settings.sparks.rate, 2);  // one in each interval of 1 / rate
}

TEST(Sparks, LandAndStayInsideTheMachine) {
  MachineSettings settings;
  settings.sparks.lifetime = {0.5, 1};
  settings.sparks.speed = {1000, 4500};  // up to 1 m: some reach the ceiling
  double lowest = kNever, highest = 0;
  for (double t = 0; t < 20; t += 0.01) {
    const ProcessTruth now = process_at(settings, t);
    for (const Spark& spark : now.sparks()) {
      ASSERT_TRUE(settings.enclosure.contains(spark.position));
      ASSERT_FALSE(settings.workpiece.contains(spark.position - Vec3{0, 0, 1e-9}));
      lowest = std::min(lowest, spark.position.z);
      highest = std::max(highest, spark.position.z);
    }
  }
  EXPECT_GT(highest, 780);
  EXPECT_LT(lowest, 40) << "some fly over the table's edge and down to the floor";
}

TEST(Sparks, HaveTheMeanRate) {
  MachineSettings settings;
  settings.sparks.rate = 200;
  settings.sparks.lifetime = {0.05, 0.05};  // shorter than any flight
  double in_the_air = 0;
  constexpr int kMoments = 20000;
  for (int i = 0; i < kMoments; ++i) {
    in_the_air += static_cast<double>(process_at(settings, i * 0.00317).spark_count);
  }
  EXPECT_NEAR(in_the_air / kMoments, 200 * 0.05, 0.1);
}

TEST(Sparks, FitTheirSlotsAtTheHighestRate) {
  MachineSettings settings;
  settings.sparks.lifetime = {0.01, 0.01};  // shorter than any flight
  settings.sparks.rate = (kMaxSparks - 2) / 0.01;
  ASSERT_TRUE(Machine::make(settings, {}));
  std::size_t most = 0;
  for (double t = -3; t < 3; t += 0.00037) {
    most = std::max(most, process_at(settings, t).spark_count);
  }
  EXPECT_GE(most, kMaxSparks - 2);
  EXPECT_LE(most, kMaxSparks);
}

TEST(Sparks, NoneWhenTheRateIsZero) {
  MachineSettings settings;
  settings.sparks.rate = 0;
  EXPECT_EQ(process_at(settings, 4).spark_count, 0U);
}

bool same(const ProcessTruth& a, const ProcessTruth& b) {
  return std::ranges::equal(a.sparks(), b.sparks(), [](const Spark& x, const Spark& y) {
    return norm(x.position - y.position) == 0 && x.radius == y.radius &&
           x.temperature == y.temperature;
  });
}

TEST(Process, FollowsFromSeedAndTimeAlone) {
  MachineSettings settings;
  const ProcessTruth first = process_at(settings, 8.25);
  process_at(settings, 1);
  EXPECT_GT(first.spark_count, 5U);
  EXPECT_TRUE(same(first, process_at(settings, 8.25)));
  settings.seed = 2;
  EXPECT_FALSE(same(first, process_at(settings, 8.25)));
}

}  // namespace
}  // namespace orbwatch::app::simulation
