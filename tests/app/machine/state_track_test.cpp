// SPDX-License-Identifier: Apache-2.0
#include "app/machine/state_track.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/app/machine/moments.h"

namespace orbwatch::app::machine {
namespace {

using tests::at_ms;

using std::chrono::milliseconds;

constexpr milliseconds kTimeout{100};

TimedState state(int ms, double x, double c = 0, double layer = 1) {
  TimedState state{at_ms(ms), *PartName::make("part " + std::to_string(ms)), {}, {0, 0, -1}};
  state.values.x = x;
  state.values.y = state.values.z = 0;
  state.values.c = c;
  state.values.layer = layer;
  return state;
}

MachineStatus reported(const StateTrack& track, int ms) {
  MachineStatus machine;
  track.report(at_ms(ms), machine);
  return machine;
}

TEST(StateTrack, PositionsLieBetweenTheStatesAndCountsAreTheEarlierOnes) {
  StateTrack track(kTimeout);
  track.add(state(1000, 10, 0, 3));
  track.add(state(1020, 14, 10, 4));
  const MachineStatus machine = reported(track, 1005);
  EXPECT_EQ(machine.quality, MachineQuality::Good);
  EXPECT_DOUBLE_EQ(machine.values.x, 11);
  EXPECT_DOUBLE_EQ(machine.values.c, 2.5);
  EXPECT_EQ(machine.values.layer, 3);
  EXPECT_EQ(machine.part.text(), "part 1000");
  EXPECT_EQ(machine.state, at_ms(1000));
  EXPECT_DOUBLE_EQ(machine.vx, 200);  // 4 mm in 20 ms
  EXPECT_EQ(reported(track, 1020).values.layer, 4);
}

TEST(StateTrack, ATurnedAxisTakesTheShorterWay) {
  StateTrack track(kTimeout);
  track.add(state(1000, 0, 350));
  track.add(state(1020, 0, 10));
  EXPECT_DOUBLE_EQ(reported(track, 1010).values.c, 360);
}

TEST(StateTrack, AfterTheLastStateTheMotionContinues) {
  StateTrack track(kTimeout);
  track.add(state(1000, 10));
  track.add(state(1020, 14, 0, 2));
  const MachineStatus machine = reported(track, 1040);
  EXPECT_EQ(machine.quality, MachineQuality::Predicted);
  EXPECT_DOUBLE_EQ(machine.values.x, 18);
  EXPECT_EQ(machine.values.layer, 2);
}

TEST(StateTrack, ASingleStateSaysNothingAboutMotion) {
  StateTrack track(kTimeout);
  track.add(state(1000, 10, 0, 5));
  const MachineStatus machine = reported(track, 1010);
  EXPECT_EQ(machine.quality, MachineQuality::Predicted);
  EXPECT_EQ(machine.values.layer, 5);
  EXPECT_TRUE(std::isnan(machine.values.x));
  EXPECT_TRUE(std::isnan(machine.vx));
}

void expect_unknown(const MachineStatus& machine) {
  EXPECT_EQ(machine.part, PartName());
  for (const MachineValue& value : kMachineValues) {
    EXPECT_TRUE(std::isnan(machine.values.*value.get)) << value.name;
  }
  for (const double motion : {machine.vx, machine.vy, machine.vz, machine.tool_x}) {
    EXPECT_TRUE(std::isnan(motion));
  }
}

TEST(StateTrack, NothingIsKnownBeforeTheFirstState) {
  StateTrack track(kTimeout);
  EXPECT_EQ(reported(track, 1000).quality, MachineQuality::NoState);
  track.add(state(1000, 10));
  const MachineStatus machine = reported(track, 999);
  EXPECT_EQ(machine.quality, MachineQuality::NoState);
  expect_unknown(machine);
}

TEST(StateTrack, NoValueOutlivesTheTimeout) {
  StateTrack track(kTimeout);
  track.add(state(1000, 10));
  track.add(state(1020, 14));
  EXPECT_FALSE(track.is_silent(at_ms(1120)));
  EXPECT_EQ(reported(track, 1120).quality, MachineQuality::Predicted);
  EXPECT_TRUE(track.is_silent(at_ms(1121)));
  const MachineStatus machine = reported(track, 1121);
  EXPECT_EQ(machine.quality, MachineQuality::Stale);
  expect_unknown(machine);
}

TEST(StateTrack, TheTimeoutBeginsWithTheArrivalOfTheLastState) {
  StateTrack track(kTimeout, milliseconds(150));
  track.add(state(1000, 10));
  track.add(state(1020, 14));
  EXPECT_FALSE(track.is_silent(at_ms(1270)));
  EXPECT_EQ(reported(track, 1270).quality, MachineQuality::Predicted);
  EXPECT_TRUE(track.is_silent(at_ms(1271)));
  EXPECT_EQ(reported(track, 1271).quality, MachineQuality::Stale);
  track.add(state(1121, 15));
  EXPECT_EQ(reported(track, 1100).quality, MachineQuality::Stale) << "a gap has no delay";
}

TEST(StateTrack, AGapBetweenTwoStatesIsNotBridged) {
  StateTrack track(kTimeout);
  track.add(state(1000, 10));
  track.add(state(1101, 14));
  expect_unknown(reported(track, 1001));
  EXPECT_EQ(reported(track, 1001).quality, MachineQuality::Stale);
}

TEST(StateTrack, AStateThatIsEarlierReplacesThoseThatWereDatedTooLate) {
  StateTrack track(kTimeout);
  track.add(state(1000, 10));
  track.add(state(1030, 13));
  track.add(state(1020, 12));
  EXPECT_DOUBLE_EQ(reported(track, 1010).values.x, 11);
}

TEST(StateTrack, KeepsTheNewestStates) {
  StateTrack track(kTimeout);
  const int count = 3 * static_cast<int>(StateTrack::kCapacity);
  for (int n = 0; n < count; ++n) track.add(state(1000 + 4 * n, n));
  const int newest = 1000 + 4 * (count - 1);
  const int oldest = newest - 4 * (static_cast<int>(StateTrack::kCapacity) - 1);
  EXPECT_EQ(reported(track, oldest - 1).quality, MachineQuality::NoState);
  for (int ms = oldest; ms <= newest; ms += 7) {
    EXPECT_DOUBLE_EQ(reported(track, ms).values.x, (ms - 1000) / 4.0);
  }
}

}  // namespace
}  // namespace orbwatch::app::machine
