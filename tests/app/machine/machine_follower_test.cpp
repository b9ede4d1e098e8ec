// SPDX-License-Identifier: Apache-2.0
#include "app/machine/machine_follower.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "app/log_writer.h"
#include "tests/app/machine/moments.h"

namespace orbwatch::app::machine {
namespace {

using tests::at_s;

using std::chrono::milliseconds;

MachineState at_x(double x) {
  MachineState state;
  state.values.x = x;
  state.values.y = state.values.z = 0;
  return state;
}

/// Tracks of 100 mm at 25 mm/s, one a layer of ten, with a turn of 0.2 s between them.
constexpr double kSpeed = 25, kTrack = 100, kTurn = 0.2, kPeriod = kTrack / kSpeed + kTurn;
double x_at(double t) {
  const double phase = std::fmod(t, 2 * kPeriod);
  const double along = std::min(std::fmod(phase, kPeriod) * kSpeed, kTrack);
  return phase < kPeriod ? along : kTrack - along;
}

struct Link {
  double period;          ///< s between two states
  double jitter;          ///< s, of their messages
  bool has_clock = true;  ///< the controller sends its clock
  double resolution = 0;  ///< s, of that clock; 0: that of the values
};

/// Reading of a controller's clock of this resolution at `t`.
double clock_at(double t, double resolution) {
  return resolution > 0 ? std::floor(t / resolution) * resolution : t;
}

/// Error of the position, ms of motion, at 99 of 100 exposures of a camera at 30/s whose frames
/// come 25 ms after the exposure.
double p99_error(const Link& link) {
  MachineFollower follower({.source = MachineSource::Dds});
  std::mt19937 random(3);
  std::uniform_real_distribution<double> late(0, link.jitter);
  std::vector<double> errors;
  double sent = 1000, arrival = 1000 + late(random);
  std::uint32_t sequence = 0;
  for (double exposure = 1002; exposure < 1300; exposure += 1 / 30.0) {
    for (; arrival <= exposure + 0.025; sent += link.period) {
      MachineState state = at_x(x_at(sent));
      state.sequence = ++sequence;
      if (link.has_clock) state.clock = clock_at(sent + 77, link.resolution);
      EXPECT_TRUE(follower.take(state, at_s(arrival)));
      arrival = std::max(arrival, sent + link.period + late(random));
    }
    const MachineStatus& machine = follower.follow(at_s(exposure), std::nullopt);
    EXPECT_FALSE(is_fault(machine.quality));
    errors.push_back(std::abs(machine.values.x - x_at(exposure)) / kSpeed * 1000);
  }
  const auto rank = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() * 99 / 100);
  std::ranges::nth_element(errors, rank);
  return *rank;
}

TEST(MachineFollower, PositionsAtExposuresAreTrueOverModbus) {
  EXPECT_LE(p99_error({.period = 0.02, .jitter = 0.02}), 2);
}

TEST(MachineFollower, PositionsAtExposuresAreTrueOverDds) {
  EXPECT_LE(p99_error({.period = 0.004, .jitter = 0.002}), 2);
}

TEST(MachineFollower, WithoutAClockTheJitterRemains) {
  EXPECT_GT(p99_error({.period = 0.02, .jitter = 0.02, .has_clock = false}), 5);
}

TEST(MachineFollower, AClockThatIsCoarserThanTheStatesIsUsed) {
  const Link link{.period = 0.004, .jitter = 0.02, .resolution = 0.01};
  EXPECT_LE(p99_error(link), 5);
  EXPECT_GT(p99_error({.period = link.period, .jitter = link.jitter, .has_clock = false}), 10);
}

/// Takes 250 states a second for 3 s of a head that moves at 25 mm/s, and checks that they are
/// known; returns the log.
std::vector<std::string> log_of(double clock_resolution) {
  std::vector<std::string> lines;
  LogWriter log([&lines](const LogRecord& line) { lines.emplace_back(line.text); });
  MachineFollower follower({.source = MachineSource::Modbus});
  for (int n = 0; n < 750; ++n) {
    const double now = 1000 + 0.004 * n;
    MachineState state = at_x(0.1 * n);
    state.sequence = static_cast<std::uint32_t>(n);
    state.clock = clock_at(now, clock_resolution);
    EXPECT_TRUE(follower.take(state, at_s(now)));
    EXPECT_FALSE(is_fault(follower.keep(at_s(now)).quality)) << now;
    const MachineStatus& machine = follower.follow(at_s(now - 0.002), std::nullopt);
    if (n < 20) continue;  // whether the clock stands is not known yet
    EXPECT_EQ(machine.quality, MachineQuality::Good) << now;
    EXPECT_NEAR(machine.values.x, 0.1 * n - 0.05, 1e-4) << now;
    EXPECT_NEAR(machine.vx, 25, 0.01) << now;
  }
  EXPECT_EQ(follower.keep(at_s(1003)).states, 750U);
  EXPECT_EQ(follower.keep(at_s(1003)).refused, 0U);
  log.flush();
  return lines;
}

TEST(MachineFollower, StatesWithAClockThatStandsCountAtTheirArrivalAndTheLogSaysSo) {
  for (const double resolution : {1e9, 1.0, 0.3}) {
    const auto lines = log_of(resolution);
    const auto of_the_clock = std::ranges::count_if(lines, [](const std::string& line) {
      return line.find("the controller's clock does not advance") != std::string::npos;
    });
    EXPECT_EQ(of_the_clock, 1) << resolution;
  }
}

TEST(MachineFollower, TheDelayIsTheAgeOfAStateOnArrival) {
  MachineFollower follower({.source = MachineSource::Modbus, .delay = milliseconds(40)});
  for (int n = 0; n <= 10; ++n) {
    ASSERT_TRUE(follower.take(at_x(n), at_s(1000.04 + 0.01 * n)));
  }
  EXPECT_NEAR(follower.follow(at_s(1000.05), std::nullopt).values.x, 5, 1e-6);
}

TEST(MachineFollower, ADelayBeyondTheTimeoutIsNotSilence) {
  MachineFollower follower(
      {.source = MachineSource::Modbus, .delay = milliseconds(600), .timeout = milliseconds(500)});
  for (int n = 0; n < 50; ++n) {
    const double now = 1000 + 0.02 * n;
    ASSERT_TRUE(follower.take(at_x(n), at_s(now)));
    if (n < 2) continue;
    EXPECT_FALSE(is_fault(follower.follow(at_s(now - 0.03), std::nullopt).quality)) << now;
    EXPECT_FALSE(is_fault(follower.keep(at_s(now)).quality)) << now;
  }
  EXPECT_FALSE(is_fault(follower.keep(at_s(1001.479)).quality));
  EXPECT_EQ(follower.keep(at_s(1001.481)).quality, MachineQuality::Stale);
}

TEST(MachineFollower, PositionAndToolAreInTheMachineFrame) {
  // The controller's x axis is the machine's y axis.
  MachineFollower follower({.source = MachineSource::Http,
                            .origin = {100, 200, 300},
                            .rotation = {-90, 0, 0},
                            .tool_axis = {0, 0, -2}});
  for (int n = 0; n < 2; ++n) {
    MachineState state = at_x(10);
    state.values.b = 90;  // turns -z to -x
    ASSERT_TRUE(follower.take(state, at_s(1000 + 0.01 * n)));
  }
  const MachineStatus& machine = follower.follow(at_s(1000.005), std::nullopt);
  EXPECT_NEAR(machine.values.x, 100, 1e-9);
  EXPECT_NEAR(machine.values.y, 210, 1e-9);
  EXPECT_NEAR(machine.values.z, 300, 1e-9);
  EXPECT_NEAR(machine.tool_x, 0, 1e-9);
  EXPECT_NEAR(machine.tool_y, -1, 1e-9);
  EXPECT_NEAR(machine.tool_z, 0, 1e-9);
}

/// The status between two states of a head that moves in x and y and does not know its z.
MachineStatus of_two_axes(const MachineSettings& settings) {
  MachineFollower follower(settings);
  for (int n = 0; n < 2; ++n) {
    MachineState state = at_x(1 + n);
    state.values.y = 2;
    state.values.z = signals::kNotValid;
    EXPECT_TRUE(follower.take(state, at_s(1000 + n * 0.1)));
  }
  return follower.follow(at_s(1000), std::nullopt);
}

TEST(MachineFollower, AnUnknownCoordinateLeavesTheOthersKnown) {
  const MachineStatus machine = of_two_axes({.source = MachineSource::Modbus});
  EXPECT_EQ(machine.values.x, 1);
  EXPECT_EQ(machine.values.y, 2);
  EXPECT_TRUE(std::isnan(machine.values.z));
  EXPECT_NEAR(machine.vx, 10, 1e-6);
  EXPECT_NEAR(machine.vy, 0, 1e-6);
  EXPECT_TRUE(std::isnan(machine.vz));
}

TEST(MachineFollower, AnUnknownCoordinateStaysAloneInATurnedFrame) {
  const MachineStatus about_z = of_two_axes(
      {.source = MachineSource::Modbus, .origin = {100, 200, 300}, .rotation = {-90, 0, 0}});
  EXPECT_NEAR(about_z.values.x, 98, 1e-9);
  EXPECT_NEAR(about_z.values.y, 201, 1e-9);
  EXPECT_TRUE(std::isnan(about_z.values.z));
  EXPECT_NEAR(about_z.vy, 10, 1e-6);

  const MachineStatus tilted =
      of_two_axes({.source = MachineSource::Modbus, .rotation = {0, 30, 0}});
  const auto& v = tilted.values;
  EXPECT_EQ(std::isnan(v.x) + std::isnan(v.y) + std::isnan(v.z), 2) << "those that z moves";
}

TEST(MachineFollower, ARepeatedStateIsIgnored) {
  MachineFollower follower({.source = MachineSource::Modbus});
  MachineState state = at_x(1);
  state.sequence = 9;
  for (int n = 0; n < 5; ++n) ASSERT_TRUE(follower.take(state, at_s(1000 + n)));
  EXPECT_EQ(follower.follow(at_s(1000), std::nullopt).states, 1U);
  EXPECT_EQ(follower.keep(at_s(1004.1)).quality, MachineQuality::Stale);
}

TEST(MachineFollower, ARefusedStateIsCountedAndChangesNothing) {
  MachineFollower follower({.source = MachineSource::Modbus});
  MachineState bad = at_x(std::numeric_limits<double>::infinity());
  bad.sequence = 1;
  EXPECT_FALSE(follower.take(bad, at_s(1000)));
  MachineState good = at_x(5);
  good.sequence = 1;
  EXPECT_TRUE(follower.take(good, at_s(1000)));
  const MachineStatus& machine = follower.follow(at_s(1000), std::nullopt);
  EXPECT_EQ(machine.refused, 1U);
  EXPECT_EQ(machine.states, 1U);
}

TEST(MachineFollower, SilenceIsNoticedWithoutAFrame) {
  MachineFollower follower({.source = MachineSource::Modbus, .timeout = milliseconds(200)});
  EXPECT_EQ(follower.keep(at_s(999)).quality, MachineQuality::NoState);
  ASSERT_TRUE(follower.take(at_x(1), at_s(1000)));
  ASSERT_TRUE(follower.take(at_x(2), at_s(1000.1)));
  follower.follow(at_s(1000.05), std::nullopt);
  EXPECT_EQ(follower.keep(at_s(1000.3)).quality, MachineQuality::Good);
  const MachineStatus& machine = follower.keep(at_s(1000.301));
  EXPECT_EQ(machine.quality, MachineQuality::Stale);
  EXPECT_TRUE(std::isnan(machine.values.x));
}

TEST(MachineFollower, AFaultEndsWithoutAFrame) {
  MachineFollower follower({.source = MachineSource::Modbus, .timeout = milliseconds(200)});
  EXPECT_EQ(follower.keep(at_s(999)).quality, MachineQuality::NoState);
  for (const double begin : {1000.0, 1003.0}) {
    ASSERT_TRUE(follower.take(at_x(1), at_s(begin)));
    ASSERT_TRUE(follower.take(at_x(2), at_s(begin + 0.02)));
    const MachineStatus& machine = follower.keep(at_s(begin + 0.03));
    EXPECT_EQ(machine.quality, MachineQuality::Predicted);
    EXPECT_TRUE(std::isnan(machine.values.x)) << "no value of another moment";
    EXPECT_NEAR(follower.follow(at_s(begin + 0.01), std::nullopt).values.x, 1.5, 1e-6);
    EXPECT_EQ(follower.keep(at_s(begin + 2)).quality, MachineQuality::Stale);
  }
}

TEST(MachineFollower, ARefusalOfAnInterfaceIsCounted) {
  MachineFollower follower({.source = MachineSource::Modbus});
  EXPECT_FALSE(follower.path().take(fail("part is not a name")));
  const MachineStatus& machine = follower.keep(at_s(1000));
  EXPECT_EQ(machine.refused, 1U);
  EXPECT_EQ(machine.states, 0U);
}

}  // namespace
}  // namespace orbwatch::app::machine
