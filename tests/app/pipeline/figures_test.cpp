#include <gtest/gtest.h>

#include "app/pipeline/display_throttle.h"
#include "app/pipeline/second_meter.h"

namespace orbwatch::app {
namespace {

using std::chrono::milliseconds;

TEST(SecondMeter, RanksTheLatenciesOfItsSecond) {
  SecondMeter meter;
  for (int i = 100; i >= 1; --i) meter.add(milliseconds(i));
  const auto figures = meter.roll(milliseconds(2000));
  EXPECT_DOUBLE_EQ(figures.per_second, 50);
  EXPECT_NEAR(figures.p50_ms, 50, 1);
  EXPECT_NEAR(figures.p99_ms, 99, 1);
  const auto empty = meter.roll(milliseconds(1000));
  EXPECT_EQ(empty.per_second, 0);
  EXPECT_EQ(empty.p99_ms, 0);
}

TEST(SecondMeter, CountsMoreThanItCanRank) {
  SecondMeter meter;
  for (int i = 0; i < 5000; ++i) meter.add(milliseconds(3));
  const auto figures = meter.roll(milliseconds(1000));
  EXPECT_DOUBLE_EQ(figures.per_second, 5000);
  EXPECT_NEAR(figures.p50_ms, 3, 1e-6);
}

TEST(DisplayThrottle, HalvesAfterAnOverrunDownToEveryEighth) {
  DisplayThrottle throttle;
  EXPECT_TRUE(throttle.is_due(1));
  for (const std::uint64_t interval : {2, 4, 8, 8}) {
    throttle.note(true, false, 10);
    EXPECT_EQ(throttle.interval(), interval);
  }
  EXPECT_FALSE(throttle.is_due(1));
  EXPECT_TRUE(throttle.is_due(8));
}

TEST(DisplayThrottle, ComesBackAfterACalmSecondOnly) {
  DisplayThrottle throttle;
  throttle.note(true, false, 10);
  throttle.note(true, false, 10);
  for (int i = 0; i < 9; ++i) throttle.note(false, true, 10);
  EXPECT_EQ(throttle.interval(), 4U);
  throttle.note(false, true, 10);
  EXPECT_EQ(throttle.interval(), 2U);
  for (int i = 0; i < 100; ++i) throttle.note(false, false, 10);
  EXPECT_EQ(throttle.interval(), 2U) << "just in time is not calm";
}

}  // namespace
}  // namespace orbwatch::app
