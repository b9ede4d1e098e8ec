// SPDX-License-Identifier: Apache-2.0
#include "hal/control_delay.h"

#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kDelay = 2;

TimePoint at(int ms) { return TimePoint(milliseconds(ms)); }

/// Frames at 100 per second: frame n is exposed at 10 n ms.
class ControlDelayTest : public testing::Test {
 protected:
  TimePoint as_of(std::uint64_t n, const char* not_as_set = nullptr) {
    FrameMetadata metadata;
    metadata.sequence = n;
    metadata.exposure_start = at(10 * static_cast<int>(n));
    metadata.not_as_set = not_as_set;
    return delay.as_of(metadata, kDelay);
  }

  ControlDelay delay;
};

TEST_F(ControlDelayTest, WithoutASettingEveryExposureHasAll) { EXPECT_EQ(as_of(3), at(30)); }

TEST_F(ControlDelayTest, CountsExposuresThatBeginAfterTheSetting) {
  delay.set(at(15));
  for (const std::uint64_t n : {0U, 1U, 2U, 3U}) EXPECT_LT(as_of(n), at(15)) << n;
  EXPECT_EQ(as_of(4), at(40));
  EXPECT_EQ(as_of(5), at(50));
}

TEST_F(ControlDelayTest, AStartHasWhatWasSetBefore) {
  delay.set(at(15));
  delay.clear();
  EXPECT_EQ(as_of(2), at(20));
}

TEST_F(ControlDelayTest, LostFramesWereExposedToo) {
  delay.set(at(15));
  EXPECT_LT(as_of(2), at(15));
  EXPECT_EQ(as_of(7), at(70));
}

TEST_F(ControlDelayTest, ASettingDuringTheWaitBeginsItAnewAndHidesNoOlderOne) {
  delay.set(at(15));
  EXPECT_LT(as_of(2), at(15));
  delay.set(at(25));
  for (const std::uint64_t n : {3U, 4U}) EXPECT_LT(as_of(n), at(15)) << n;
  EXPECT_EQ(as_of(5), at(50));
}

TEST_F(ControlDelayTest, WhatAFrameStatesCountsMoreThanTime) {
  delay.set(at(15));
  for (const std::uint64_t n : {2U, 3U, 4U, 50U}) EXPECT_LT(as_of(n, "ExposureTime"), at(15)) << n;
  EXPECT_EQ(as_of(51), at(510));
  EXPECT_EQ(as_of(52, "ExposureTime"), at(520)) << "it was set, and is the camera's affair now";
}

}  // namespace
}  // namespace orbwatch::hal
