// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/spatter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "proc/optics/vec.h"

namespace orbwatch::signals {
namespace {

using optics::Vec3;

constexpr double kFrameTime = 1.0 / 30;
const Vec3 kHotSpot{0, std::sqrt(0.5), -std::sqrt(0.5)};
// Directions across the hot spot's.
const Vec3 kRight{1, 0, 0};
const Vec3 kUp{0, std::sqrt(0.5), std::sqrt(0.5)};

/// A spark on a great circle out of the hot spot.
struct Flight {
  double born = 0;   // s
  double ends = 0;   // s
  double way = 0;    // degrees, 0 right, 90 up
  double speed = 0;  // deg/s

  bool in_air(double now) const { return now > born && now <= ends; }
  Vec3 at(double now) const {
    const double path = optics::radians(speed * (now - born)), angle = optics::radians(way);
    return kHotSpot * std::cos(path) +
           (kRight * std::cos(angle) + kUp * std::sin(angle)) * std::sin(path);
  }
};

Signals follow(SpatterTracker& tracker, const std::vector<Flight>& flights, double seconds,
               const std::vector<int>& hidden_frames = {}) {
  Signals signals;
  for (int frame = 0; frame * kFrameTime <= seconds; ++frame) {
    for (const Flight& flight : flights) {
      const bool hidden = std::ranges::count(hidden_frames, frame) > 0;
      if (flight.in_air(frame * kFrameTime) && !hidden)
        tracker.add(flight.at(frame * kFrameTime) * 1e-4);
    }
    tracker.update(frame * kFrameTime, kHotSpot);
    signals = {};
    tracker.write(signals);
  }
  return signals;
}

TEST(Spatter, EachSparkIsNewOnceAndHasItsSpeed) {
  SpatterTracker tracker;
  std::vector<Flight> flights;
  for (int i = 0; i < 9; ++i) flights.push_back({0.01 + 0.05 * i, 0.3 + 0.05 * i, 40.0 * i, 120});
  const Signals signals = follow(tracker, flights, 0.95);
  EXPECT_EQ(signals.spatter_rate, 9);
  EXPECT_EQ(signals.spatter_count, 0) << "all have landed";
  EXPECT_NEAR(signals.spatter_speed, 120, 2);
  EXPECT_EQ(signals.spatter_speed_100, 9);
}

TEST(Spatter, SpeedsGoIntoTheirBins) {
  SpatterTracker tracker;
  std::vector<Flight> flights;
  for (int i = 0; i < 8; ++i) flights.push_back({0.01, 0.21, 45.0 * i, 25 + 50.0 * i});
  const Signals s = follow(tracker, flights, 0.6);
  for (const double in_bin :
       {s.spatter_speed_0, s.spatter_speed_50, s.spatter_speed_100, s.spatter_speed_150,
        s.spatter_speed_200, s.spatter_speed_250, s.spatter_speed_300, s.spatter_speed_350}) {
    EXPECT_EQ(in_bin, 1);
  }
  EXPECT_NEAR(s.spatter_speed, 200, 5);
}

TEST(Spatter, AMissedSparkIsNotNewAgain) {
  SpatterTracker tracker;
  EXPECT_EQ(follow(tracker, {{0.01, 0.5, 30, 100}}, 0.7, {6}).spatter_rate, 1);
}

TEST(Spatter, SparksThatCrossStayTwo) {
  constexpr double kSpeed = 100;  // deg/s, towards each other
  SpatterTracker tracker;
  Signals signals;
  double fewest = 2;
  for (int frame = 0; frame < 12; ++frame) {
    for (const double sense : {-1.0, 1.0}) {
      const double yaw = optics::radians(sense * (kSpeed * frame * kFrameTime - 17));
      tracker.add({std::sin(yaw), std::cos(yaw), 0});
    }
    tracker.update(frame * kFrameTime, {});
    tracker.write(signals);
    fewest = std::min(fewest, signals.spatter_count);
  }
  EXPECT_EQ(fewest, 1) << "they were one for a moment";
  EXPECT_EQ(signals.spatter_rate, 2);
}

TEST(Spatter, PartsOfASparkAreOne) {
  SpatterTracker tracker;
  tracker.add(Vec3{0, 1, 0} * 2e-4);
  tracker.add(optics::normalized({0.02, 1, 0}) * 1e-4);
  tracker.update(0, {});
  Signals signals;
  tracker.write(signals);
  EXPECT_EQ(signals.spatter_count, 1);
}

TEST(Spatter, MoreThanCanBeFollowedAreCounted) {
  SpatterTracker tracker;
  const int sparks = static_cast<int>(kMaxSparks) + 20;
  for (int i = 0; i < sparks; ++i) {
    const double yaw = optics::radians(6.0 * (i % 50)), pitch = optics::radians(6.0 * (i / 50) - 9);
    tracker.add(
        {std::cos(pitch) * std::sin(yaw), std::cos(pitch) * std::cos(yaw), std::sin(pitch)});
  }
  tracker.update(0, {});
  Signals signals;
  tracker.write(signals);
  EXPECT_EQ(signals.spatter_count, sparks);
  EXPECT_EQ(signals.spatter_rate, static_cast<double>(kMaxSparks));
  EXPECT_EQ(tracker.untracked(), 20U);
}

/// The largest number of blobs that a picture of 640x480 can have, all over the sphere.
TEST(Spatter, NoiseAtTheThresholdCostsABoundedWorkAndWhatItDropsIsCounted) {
  constexpr int kParts = 640 / 2 * 480 / 2;
  SpatterTracker tracker;
  std::uint64_t before = 0;
  for (int frame = 0; frame < 3; ++frame) {
    for (int i = 0; i < kParts; ++i) {
      const double z = 2 * (i + 0.5) / kParts - 1, level = std::sqrt(1 - z * z);
      tracker.add({level * std::cos(i), level * std::sin(i), z});
    }
    tracker.update(frame / 30.0, {});
    const std::uint64_t work = tracker.comparisons() - before;
    before = tracker.comparisons();
    EXPECT_LE(work, kMaxSparks * (kMaxSparkParts + kMaxSparks)) << frame;
    EXPECT_GT(work, 0U);
  }
  Signals signals;
  tracker.write(signals);
  EXPECT_GE(signals.spatter_untracked, 3 * (kParts - static_cast<double>(kMaxSparkParts)));
  EXPECT_EQ(signals.spatter_untracked, static_cast<double>(tracker.untracked()));
  EXPECT_LE(signals.spatter_rate, 3.0 * kMaxSparks);
}

TEST(Spatter, ASecondLaterNothingIsLeft) {
  SpatterTracker tracker;
  const Signals signals = follow(tracker, {{0.01, 0.2, 30, 100}}, 1.6);
  EXPECT_EQ(signals.spatter_rate, 0);
  EXPECT_FALSE(is_valid(signals.spatter_speed));
}

}  // namespace
}  // namespace orbwatch::signals
