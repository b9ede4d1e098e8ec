// SPDX-License-Identifier: Apache-2.0
#include "hal/genicam/clock/block_counter.h"

#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

TEST(BlockCounter, GrowsWithTheIds) {
  BlockCounter counter;
  EXPECT_EQ(counter.number(17), 0U);
  EXPECT_EQ(counter.number(18), 1U);
  EXPECT_EQ(counter.number(21), 4U);
}

TEST(BlockCounter, SixteenBitsWrapToOne) {
  BlockCounter counter;
  EXPECT_EQ(counter.number(65534), 0U);
  EXPECT_EQ(counter.number(65535), 1U);
  EXPECT_EQ(counter.number(1), 2U);
  EXPECT_EQ(counter.number(4), 5U);
}

TEST(BlockCounter, SixtyFourBitsDoNotWrap) {
  BlockCounter counter;
  EXPECT_EQ(counter.number(65535), 0U);
  EXPECT_EQ(counter.number(65536), 1U);
  EXPECT_EQ(counter.number(65538), 3U);
}

TEST(BlockCounter, AFrameWithoutAnIdFollowsTheOneBefore) {
  BlockCounter counter;
  EXPECT_EQ(counter.number(5), 0U);
  EXPECT_EQ(counter.number(std::nullopt), 1U);
  EXPECT_EQ(counter.number(7), 2U);
  EXPECT_EQ(counter.number(std::nullopt), 3U);
  EXPECT_EQ(counter.number(std::nullopt), 4U);
  EXPECT_EQ(counter.number(12), 7U) << "two more were lost whole";
}

TEST(BlockCounter, TheFirstFramesMayBeWithoutAnId) {
  BlockCounter counter;
  EXPECT_EQ(counter.number(std::nullopt), 1U);
  EXPECT_EQ(counter.number(40), 2U);
}

TEST(BlockCounter, IdsThatStandStillOrGoBackCountAsOne) {
  BlockCounter counter;
  EXPECT_EQ(counter.number(100), 0U);
  EXPECT_EQ(counter.number(100), 1U);
  EXPECT_EQ(counter.number(3), 2U) << "the camera was restarted";
  EXPECT_EQ(counter.number(4), 3U);
}

}  // namespace
}  // namespace orbwatch::hal
