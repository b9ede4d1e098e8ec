// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "proc/signals/alarm.h"
#include "tests/proc/signals/alarm_clock.h"
#include "tests/proc/signals/reference_alarm.h"

namespace orbwatch::signals {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using tests::kNoValue;
using tests::ReferenceAlarm;

class RandomAlarm {
 public:
  explicit RandomAlarm(unsigned seed) : random_(seed) {}

  int number(int low, int high) { return std::uniform_int_distribution(low, high)(random_); }
  bool one_in(int count) { return number(1, count) == 1; }

  /// Random limits out of -20, -10, 10 and 20; values are sums of quarters, so that comparisons are
  /// exact.
  AlarmLimits limits() {
    AlarmLimits limits;
    if (!one_in(4)) limits.low_alarm = -20;
    if (!one_in(4)) limits.low_warning = -10;
    if (!one_in(4)) limits.high_warning = 10;
    limits.high_alarm = 20;
    limits.hysteresis = 0.25 * number(0, 12);
    limits.on_delay = milliseconds(250 * number(0, 6));
    limits.off_delay = milliseconds(250 * number(0, 6));
    limits.loss_delay = milliseconds(250 * number(0, 8));
    if (one_in(4)) limits.loss_delay.reset();
    limits.latching = one_in(2);
    limits.only_while_active = !one_in(4);
    return limits;
  }

  /// Mostly the frame period, sometimes another time.
  nanoseconds time_passed() {
    if (one_in(50)) return milliseconds(-5000);
    if (one_in(50)) return milliseconds(30000);
    return milliseconds(125 * number(0, 3));
  }

  /// A random walk through all limits that stays near them for a while, with measurements that fail
  /// for a while.
  double value() {
    if (one_in(8)) walk_ = 0.25 * number(-100, 100);
    walk_ += 0.25 * number(-6, 6);
    if (one_in(missing_ ? 4 : 25)) missing_ = !missing_;
    return missing_ ? kNoValue : walk_;
  }

  bool active() {
    if (one_in(active_ ? 60 : 8)) active_ = !active_;
    return active_;
  }

 private:
  std::mt19937 random_;
  double walk_ = 0;
  bool missing_ = false;
  bool active_ = true;
};

struct Visited {
  std::map<AlarmState, int> states;
  std::map<AlarmLevel, int> levels;
};

void run(unsigned seed, Visited& visited) {
  RandomAlarm random(seed);
  const AlarmLimits limits = random.limits();
  AlarmMemory memory;
  ReferenceAlarm reference(limits);
  nanoseconds now = std::chrono::hours(10);
  for (int i = 0; i < 300; ++i) {
    if (random.one_in(10)) {
      memory = acknowledge(limits, memory);
      reference.acknowledge();
    }
    now += random.time_passed();
    const AlarmInputs inputs{now, random.value(), random.active()};
    const Alarm before = memory.alarm;
    memory = step(limits, memory, inputs);
    reference.step(inputs.now, inputs.value, inputs.process_active);
    const Alarm& after = memory.alarm;
    ++visited.states[after.state];
    ++visited.levels[after.level];
    ASSERT_EQ(after, reference.alarm())
        << "seed " << seed << ", step " << i << ": " << operator_text(after.state) << ", "
        << operator_text(after.level) << " instead of " << operator_text(reference.alarm().state)
        << ", " << operator_text(reference.alarm().level);
    if (is_suppressed(limits, inputs)) continue;
    if (std::isfinite(inputs.value)) {
      ASSERT_FALSE(after.level == AlarmLevel::NoMeasurement && is_raised(before, after));
    } else {
      ASSERT_TRUE(after.level == before.level || after.level == AlarmLevel::NoMeasurement);
    }
  }
}

TEST(AlarmProperty, AgreesWithItsDefinitionOnRandomSequences) {
  Visited visited;
  for (unsigned seed = 1; seed <= 400 && !HasFatalFailure(); ++seed) run(seed, visited);
  EXPECT_EQ(visited.states.size(), 7U);
  EXPECT_EQ(visited.levels.size(), 6U);
  for (const auto& [state, count] : visited.states) EXPECT_GT(count, 500) << operator_text(state);
  for (const auto& [level, count] : visited.levels) EXPECT_GT(count, 500) << operator_text(level);
}

}  // namespace
}  // namespace orbwatch::signals
