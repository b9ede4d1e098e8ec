// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/streams/recent_views.h"

#include <gtest/gtest.h>

#include "tests/app/ports/dds/test_views.h"

namespace orbwatch::app::web::tests {
namespace {

using app::tests::make_view;

const hal::TimePoint kNow = hal::TimePoint{} + std::chrono::hours(1);

TEST(RecentViews, AreWantedWhileSomebodyPoints) {
  RecentViews recent;
  EXPECT_FALSE(recent.wants(1, kNow));
  recent.point(1, kNow);
  EXPECT_TRUE(recent.wants(1, kNow));
  EXPECT_FALSE(recent.wants(0, kNow)) << "into another view";
  EXPECT_FALSE(recent.wants(1, kNow + RecentViews::kPointing));
  recent.point(kMaxViews, kNow);
  EXPECT_FALSE(recent.wants(kMaxViews, kNow)) << "there is none";
}

TEST(RecentViews, AreTheNewestOfAllViewsTogether) {
  RecentViews recent;
  for (std::uint64_t number = 1; number <= RecentViews::kMost; ++number) {
    recent.keep(make_view(number % 2, "", 100 + number, 4, 4), number);
  }
  ASSERT_TRUE(recent.find(1, 1));
  EXPECT_EQ(recent.find(1, 1)->frame_set, 101U);
  EXPECT_EQ(recent.find(0, 1), nullptr) << "number 1 was of the other view";
  recent.keep(make_view(0, "", 200, 4, 4), 50);
  EXPECT_EQ(recent.find(1, 1), nullptr) << "replaced";
  EXPECT_TRUE(recent.find(0, 2));
  EXPECT_EQ(recent.find(0, 50)->frame_set, 200U);
}

TEST(RecentViews, ReturnToTheirBuffersWhenNobodyPoints) {
  RecentViews recent;
  const ViewPtr one = make_view(0, "", 1, 4, 4), other = make_view(1, "", 2, 4, 4);
  recent.keep(one, 1);
  recent.keep(other, 1);
  recent.point(1, kNow);
  recent.release_unwanted(kNow);
  EXPECT_EQ(one.use_count(), 1);
  EXPECT_EQ(other.use_count(), 2);
  recent.release_all();
  EXPECT_EQ(other.use_count(), 1);
}

}  // namespace
}  // namespace orbwatch::app::web::tests
