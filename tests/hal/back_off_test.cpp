#include "hal/back_off.h"

#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

using namespace std::chrono_literals;

TEST(BackOff, DoublesUpToTenSecondsUntilItIsReset) {
  BackOff pause;
  for (const auto expected : {1s, 2s, 4s, 8s, 10s, 10s}) EXPECT_EQ(pause.next(), expected);
  pause.reset();
  EXPECT_EQ(pause.next(), 1s);
  EXPECT_EQ(pause.next(), 2s);
}

TEST(StallTimeout, IsFivePeriodsAndASecondAtLeast) {
  EXPECT_EQ(stall_timeout(60), 1s);
  EXPECT_EQ(stall_timeout(5), 1s);
  EXPECT_EQ(stall_timeout(0.5), 10s);
  EXPECT_EQ(stall_timeout(0), 5s);
}

}  // namespace
}  // namespace orbwatch::hal
