// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/participant/rate_limit.h"

#include <gtest/gtest.h>

#include <chrono>

namespace orbwatch::app::dds {
namespace {

using std::chrono::seconds;

TEST(RateLimitTest, AdmitsTheLimitPerPeriodAndTellsWhatItWithheld) {
  RateLimit limit(2, seconds(60));
  const hal::TimePoint start = hal::Clock::now();
  EXPECT_EQ(limit.admit(start), 0u);
  EXPECT_EQ(limit.admit(start + seconds(1)), 0u);
  for (int i = 0; i < 1400; ++i) EXPECT_EQ(limit.admit(start + seconds(2)), std::nullopt);
  EXPECT_EQ(limit.admit(start + seconds(59)), std::nullopt);
  EXPECT_EQ(limit.admit(start + seconds(60)), 1401u);
  EXPECT_EQ(limit.admit(start + seconds(61)), 0u);
  EXPECT_EQ(limit.admit(start + seconds(62)), std::nullopt);
}

}  // namespace
}  // namespace orbwatch::app::dds
