// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "proc/align/drift/drift_monitor.h"
#include "tests/support/error_distribution.h"
#include "tests/support/picture_of_mat.h"
#include "tests/support/process_sequence.h"
#include "tests/support/share.h"

/// An hour of a simulated process: no false alarm, and small drifts found in it.
namespace orbwatch::tests {
namespace {

using align::DriftLevel;
using align::DriftMonitor;
using align::DriftState;
using optics::Vec3;

constexpr align::DriftLimits kLimits{0.3, 0.6};

ProcessSettings colour(std::uint64_t seed, double radius) {
  return {seed, static_cast<int>(2.7 * radius), static_cast<int>(2.2 * radius), radius, 12, false};
}

ProcessSettings thermal(std::uint64_t seed) { return {seed, 320, 256, 110, 12, true}; }

/// The alignment that would have been stored for the sequence's camera.
align::DriftSubject stored(const ProcessSequence& sequence, const ProcessSettings& s) {
  const double f = sequence.focal_length();
  const auto lens =
      optics::Lens::make({s.width, s.height, f, f, (s.width - 1) / 2.0, (s.height - 1) / 2.0});
  const auto projection = optics::BallProjection::make(
      optics::BallModel::Kind::Exact, {*lens, {{}, -sequence.ball()}, std::nullopt}, {{}, 1});
  const TrueLimb limb = sequence.limb();
  return {s.width, s.height,
          projection->outline().value_or(optics::Outline{limb.centre, limb.rx, limb.ry, 0}),
          *projection, *lens};
}

/// A monitor with the beginning of the sequence as reference.
class Watch {
 public:
  Watch(ProcessSequence& sequence, const ProcessSettings& settings)
      : sequence_(sequence),
        monitor_(DriftMonitor::make(stored(sequence, settings), kLimits).value()) {}

  DriftState at(double seconds, const Vec3& turn = {}) {
    const std::chrono::duration<double> time(seconds);
    return monitor_
        .observe(picture_of_mat(sequence_.frame(seconds, turn)),
                 std::chrono::duration_cast<DriftMonitor::Time>(time))
        .value();
  }

 private:
  ProcessSequence& sequence_;
  DriftMonitor monitor_;
};

/// Frames are 1/6 s apart: events that last for seconds, or for single frames, are the same.
void expect_no_alarm(const ProcessSettings& settings, double seconds) {
  constexpr double kRate = 6;
  ProcessSequence sequence(settings);
  Watch watch(sequence, settings);
  int measured = 0, alarms = 0;
  double worst = 0;
  const int frames = static_cast<int>(seconds * kRate);
  for (int n = 0; n < frames; ++n) {
    const DriftState state = watch.at(n / kRate);
    if (state.level == DriftLevel::NotMeasured) continue;
    ++measured;
    worst = std::max(worst, state.direction_error);
    if (state.level == DriftLevel::Good) continue;
    ++alarms;
    std::printf("%.1f s: %.2f deg\n", n / kRate, state.direction_error);
  }
  std::printf("seed %d: %d of %d frames measured, %d alarms, largest mean %.3f deg\n",
              static_cast<int>(settings.seed), measured, frames, alarms, worst);
  testing::Test::RecordProperty("alarms", alarms);
  EXPECT_EQ(alarms, 0);
  EXPECT_GT(measured, frames * 8 / 10);
}

constexpr double kHour = 3600;

TEST(DriftGate, NoAlarmInAnHour) {
  expect_no_alarm(colour(31'001, 200), kHour / 100 * share_of(100));
}

TEST(DriftGate, NoAlarmInAnHourOfAThermalCamera) {
  expect_no_alarm(thermal(31'002), kHour / 100 * share_of(100));
}

/// Drifts at random moments of the hour.
class Drifts {
 public:
  Drifts(double degrees, double patience, double precision)
      : degrees_(degrees), patience_(patience), precision_(precision) {}

  /// Turns the camera about its centre.
  void turn(ProcessSequence& sequence, const ProcessSettings& settings, std::uint64_t seed) {
    random_.seed(seed);
    Watch watch(sequence, settings);
    const double begin = work(watch, sequence);
    const double way = in(0, 2 * std::numbers::pi), f = sequence.focal_length();
    const Vec3 axis{std::cos(way), std::sin(way), in(-0.5, 0.5)}, ball = sequence.ball();
    Vec3 turn = axis * (0.005 * settings.radius / f);
    for (int i = 0; i < 2; ++i) turn = turn * (degrees_ / true_view_error(f, ball, ball, turn));
    watch_on(watch, begin, turn, true_view_error(f, ball, ball, turn));
  }

  /// Pushes the camera aside.
  void push(ProcessSequence& sequence, const ProcessSettings& settings, std::uint64_t seed) {
    random_.seed(seed);
    sequence.shift_ball({0.05, 0.02});
    const Vec3 ball = sequence.ball();
    Watch watch(sequence, settings);
    const double begin = work(watch, sequence);
    const double way = in(0, 2 * std::numbers::pi);
    // 1.6 degrees correspond to 1 % of the radius.
    const double share = degrees_ / 160 * settings.radius / (settings.width / 2.0);
    sequence.shift_ball({0.05 + share * std::cos(way),
                         0.02 + share * std::sin(way) * settings.width / settings.height});
    const double f = sequence.focal_length();
    watch_on(watch, begin, {}, true_view_error(f, ball, sequence.ball(), {}));
  }

  void expect_found() const {
    errors_.report();
    std::printf("%d missed, the last found after %.2f s\n", missed_, latest_);
    testing::Test::RecordProperty("missed", missed_);
    EXPECT_EQ(missed_, 0);
    EXPECT_LE(errors_.max(), precision_);
  }

 private:
  static constexpr double kRate = 30, kBefore = 2.5;

  double in(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  /// Runs the beginning, then a random part of the hour; returns the time of the next event.
  double work(Watch& watch, const ProcessSequence& sequence) {
    for (double t = 0; t < kBefore; t += 1 / kRate) watch.at(t);
    double begin = 0;
    do {
      begin = in(20, kHour - 20);
    } while (sequence.is_dark(begin - kBefore) || sequence.is_dark(begin + patience_));
    for (double t = begin - kBefore; t < begin; t += 1 / kRate) watch.at(t);
    return begin;
  }

  void watch_on(Watch& watch, double begin, const Vec3& turn, double truth) {
    double found_after = -1;
    DriftState state;
    for (double t = 0; t <= patience_; t += 1 / kRate) {
      state = watch.at(begin + t, turn);
      if (state.level >= DriftLevel::Warning && found_after < 0) found_after = t;
    }
    const double error = std::abs(state.direction_error - truth);
    errors_.add(error);
    latest_ = std::max(latest_, found_after);
    missed_ += found_after < 0 ? 1 : 0;
    if (found_after < 0 || error > precision_) {
      std::printf("%.3f deg found after %.2f s, off by %.3f deg\n", truth, found_after, error);
    }
  }

  double degrees_, patience_, precision_;
  std::mt19937_64 random_;
  ErrorDistribution errors_{"drift, deg"};
  double latest_ = 0;
  int missed_ = 0;
};

/// One room serves five cases.
template <class Settings>
void expect_turns_found(Drifts drifts, std::uint64_t seed, const Settings& settings_of) {
  const int cases = share_of(50);
  for (int n = 0; n < cases;) {
    const ProcessSettings settings = settings_of(seed + static_cast<std::uint64_t>(n));
    ProcessSequence sequence(settings);
    for (int end = std::min(n + 5, cases); n < end; ++n) {
      drifts.turn(sequence, settings, seed * 1000 + static_cast<std::uint64_t>(n));
    }
  }
  drifts.expect_found();
}

TEST(DriftGate, HalfADegreeIsFoundWithinASecond) {
  expect_turns_found({0.5, 1, 0.1}, 32'000, [](std::uint64_t seed) { return colour(seed, 300); });
}

TEST(DriftGate, ADegreeIsFoundByAThermalCamera) {
  expect_turns_found({1, 3, 0.3}, 33'000, thermal);
}

TEST(DriftGate, ACameraPushedAsideIsFound) {
  Drifts drifts(0.5, 1, 0.1);
  const int cases = share_of(10);
  for (int n = 0; n < cases; ++n) {
    const auto seed = 34'000 + static_cast<std::uint64_t>(n);
    const ProcessSettings settings = colour(seed, 300);
    ProcessSequence sequence(settings);
    drifts.push(sequence, settings, seed);
  }
  drifts.expect_found();
}

}  // namespace
}  // namespace orbwatch::tests
