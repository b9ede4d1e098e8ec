// SPDX-License-Identifier: Apache-2.0
#include "hal/device_camera.h"

#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

TEST(FrameCounter, StartsAtZeroAndShowsGaps) {
  FrameCounter counter;
  EXPECT_EQ(counter.number(17), 0U);
  EXPECT_EQ(counter.number(18), 1U);
  EXPECT_EQ(counter.number(21), 4U);
  EXPECT_EQ(counter.number(22), 5U);
}

TEST(FrameCounter, GoesOnWhereTheDriversCounterWraps) {
  FrameCounter counter;
  EXPECT_EQ(counter.number(UINT32_MAX - 1), 0U);
  EXPECT_EQ(counter.number(UINT32_MAX), 1U);
  EXPECT_EQ(counter.number(0), 2U);
  EXPECT_EQ(counter.number(2), 4U);
}

TEST(FrameCounter, CountsItselfWhenTheDriverDoesNot) {
  FrameCounter counter;
  for (std::uint64_t n = 0; n < 5; ++n) EXPECT_EQ(counter.number(0), n);
}

TEST(FrameCounter, NeverGoesBack) {
  FrameCounter counter;
  EXPECT_EQ(counter.number(100), 0U);
  EXPECT_EQ(counter.number(99), 1U);
  EXPECT_EQ(counter.number(100), 2U);
}

TEST(FrameCounter, FollowsOnWhenTheStreamStartsAnew) {
  FrameCounter counter;
  counter.number(0);
  counter.number(1);
  counter.restart();
  EXPECT_EQ(counter.number(0), 2U);
  EXPECT_EQ(counter.number(3), 5U);
  counter.restart();
  EXPECT_EQ(counter.number(900), 6U);
}

}  // namespace
}  // namespace orbwatch::hal
