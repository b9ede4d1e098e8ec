// SPDX-License-Identifier: Apache-2.0
#include "hal/damage_watch.h"

#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

/// Frames of a camera at 30 frames per second for the watch.
class DamageWatchTest : public testing::Test {
 protected:
  bool damaged(int count = 1) {
    bool is_fault = false;
    for (int n = 0; n < count; ++n) is_fault = watch.add_damaged(moment += kPeriod);
    return is_fault;
  }
  bool intact(int count = 1) {
    bool is_fault = false;
    for (int n = 0; n < count; ++n) is_fault = watch.add_intact(moment += kPeriod);
    return is_fault;
  }

  static constexpr auto kPeriod = 33ms;
  DamageWatch watch;
  TimePoint moment{100s};
};

TEST_F(DamageWatchTest, AFewDamagedFramesAreNoFault) {
  EXPECT_FALSE(damaged(4));
  EXPECT_FALSE(intact());
}

TEST_F(DamageWatchTest, FiveInARowAreAFault) {
  EXPECT_FALSE(damaged(4));
  EXPECT_TRUE(damaged());
}

TEST_F(DamageWatchTest, AQuarterIsAFaultAndAFifthIsNot) {
  for (int n = 0; n < 100; ++n) {
    EXPECT_FALSE(damaged());
    EXPECT_FALSE(intact(4));
  }
  watch.clear();
  bool is_fault = false;
  for (int n = 0; n < 5; ++n) {
    EXPECT_FALSE(is_fault) << n;
    is_fault = damaged();
    EXPECT_EQ(intact(3), is_fault);
  }
  EXPECT_TRUE(is_fault);
}

TEST_F(DamageWatchTest, AFaultEndsASecondAfterTheLastDamagedFrame) {
  ASSERT_TRUE(damaged(5));
  EXPECT_TRUE(intact(20)) << "none of the last 20 is damaged, but for less than a second";
  EXPECT_TRUE(damaged());
  EXPECT_TRUE(intact(30));
  EXPECT_FALSE(intact());
  EXPECT_FALSE(damaged(4)) << "what was before is forgotten";
}

TEST_F(DamageWatchTest, ACameraWithFewFramesIsTrustedWithTheNextIntactOne) {
  ASSERT_TRUE(damaged(5));
  EXPECT_FALSE(watch.add_intact(moment + 1s));
}

TEST_F(DamageWatchTest, ABadCameraHasOneFault) {
  ASSERT_TRUE(damaged(5));
  for (int n = 0; n < 1000; ++n) ASSERT_TRUE(n % 20 == 0 ? damaged() : intact()) << n;
}

}  // namespace
}  // namespace orbwatch::hal
