// SPDX-License-Identifier: Apache-2.0

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>

#include "proc/signals/alarm.h"
#include "tests/proc/signals/alarm_clock.h"

namespace orbwatch::signals {
namespace {

using std::chrono::milliseconds;
using tests::AlarmClock;
using tests::kNoValue;
using State = AlarmState;

/// Limits with a warning at 10 and an alarm at 20, without delays.
AlarmLimits at_once(bool latching) {
  AlarmLimits limits;
  limits.high_warning = 10;
  limits.high_alarm = 20;
  limits.loss_delay = milliseconds(0);
  limits.latching = latching;
  return limits;
}

/// An alarm brought into a state at warning level, from the start, through inputs alone.
AlarmClock brought_to(State state, bool latching) {
  AlarmClock clock(at_once(latching));
  clock.after(milliseconds(1), 0);
  if (state == State::Normal) return clock;
  if (state == State::SuppressedByDesign) {
    clock.set_active(false);
    clock.after(milliseconds(1), 0);
    clock.set_active(true);
    return clock;
  }
  clock.after(milliseconds(1), 12);
  if (state == State::Acknowledged || state == State::LatchedAcknowledged) clock.acknowledge();
  if (state != State::Unacknowledged && state != State::Acknowledged) {
    clock.after(milliseconds(1), 0);
  }
  return clock;
}

/// Next state for every input: one row of the state diagram.
struct Row {
  State from;
  bool latching;
  State within, warning, alarm, lost, acknowledged, inactive;
};

constexpr auto N = State::Normal;
constexpr auto U = State::Unacknowledged;
constexpr auto A = State::Acknowledged;
constexpr auto R = State::ReturnedUnacknowledged;
constexpr auto LU = State::LatchedUnacknowledged;
constexpr auto LA = State::LatchedAcknowledged;
constexpr auto S = State::SuppressedByDesign;

constexpr Row kDiagram[] = {
    {N, false, N, U, U, U, N, S},    //
    {U, false, R, U, U, U, A, S},    //
    {A, false, N, A, U, U, A, S},    //
    {R, false, R, U, U, U, N, S},    //
    {S, false, N, U, U, U, S, S},    //
    {N, true, N, U, U, U, N, S},     //
    {U, true, LU, U, U, U, A, LU},   //
    {A, true, LA, A, U, U, A, LA},   //
    {LU, true, LU, U, U, U, N, LU},  //
    {LA, true, LA, U, U, U, N, LA},  //
    {S, true, N, U, U, U, S, S},     //
};

class StateDiagram : public testing::TestWithParam<Row> {
 protected:
  AlarmClock start() const { return brought_to(GetParam().from, GetParam().latching); }
};

TEST_P(StateDiagram, EveryTransition) {
  const Row& row = GetParam();
  ASSERT_EQ(start().state(), row.from);
  EXPECT_EQ(start().after(milliseconds(1), 5).state, row.within);
  EXPECT_EQ(start().after(milliseconds(1), 12).state, row.warning);
  EXPECT_EQ(start().after(milliseconds(1), 25).state, row.alarm);
  EXPECT_EQ(start().after(milliseconds(1), kNoValue).state, row.lost);
  EXPECT_EQ(start().acknowledge().state, row.acknowledged);
  AlarmClock inactive = start();
  inactive.set_active(false);
  EXPECT_EQ(inactive.after(milliseconds(1), 25).state, row.inactive);
}

TEST_P(StateDiagram, AnAcknowledgementThatChangesNothingIsNotAwaited) {
  const Row& row = GetParam();
  EXPECT_EQ(awaits_acknowledgement(row.from), row.acknowledged != row.from);
}

TEST_P(StateDiagram, StandsWhileItsConditionHoldsOrItIsLatched) {
  const Alarm alarm = start().alarm();
  const bool latched = alarm.state == LU || alarm.state == LA;
  EXPECT_EQ(is_active(alarm.state), alarm.level != AlarmLevel::None || latched);
}

INSTANTIATE_TEST_SUITE_P(Alarm, StateDiagram, testing::ValuesIn(kDiagram));

/// Texts by number up to the first number without one; all of them differ.
template <class Enum>
std::map<int, std::string> texts() {
  std::map<int, std::string> all;
  std::set<std::string> seen;
  for (int number = 0; number < 256; ++number) {
    const auto text = std::string(operator_text(static_cast<Enum>(number)));
    if (text.empty()) continue;
    all[number] = text;
    EXPECT_TRUE(seen.insert(text).second) << text << " twice";
  }
  return all;
}

TEST(AlarmTexts, EveryNumberWithoutGapsHasItsOwn) {
  EXPECT_EQ(texts<AlarmState>().size(), 7U);
  EXPECT_EQ(texts<AlarmState>().rbegin()->first, 6);
  EXPECT_EQ(texts<AlarmLevel>().size(), 6U);
  EXPECT_EQ(texts<AlarmLevel>().rbegin()->first, 5);
  EXPECT_EQ(texts<AlarmEventKind>().size(), 5U);
  EXPECT_EQ(texts<AlarmEventKind>().rbegin()->first, 4);
}

}  // namespace
}  // namespace orbwatch::signals
