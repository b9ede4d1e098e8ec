// SPDX-License-Identifier: Apache-2.0
#include "hal/calendar_time.h"

#include <gtest/gtest.h>

namespace orbwatch::hal {
namespace {

using namespace std::chrono;

constexpr sys_seconds at(year_month_day day, seconds time) { return sys_days(day) + time; }

TEST(CalendarTime, CountsBeyondWhatATimeOf32BitHolds) {
  const std::tm fields = calendar_time(at(2105y / February / 28, 86399s));
  EXPECT_EQ(fields.tm_year, 205);
  EXPECT_EQ(fields.tm_mon, 1);
  EXPECT_EQ(fields.tm_mday, 28);
  EXPECT_EQ(fields.tm_hour, 23);
  EXPECT_EQ(fields.tm_min, 59);
  EXPECT_EQ(fields.tm_sec, 59);
  EXPECT_EQ(fields.tm_wday, 6);
  EXPECT_EQ(fields.tm_yday, 58);
  EXPECT_EQ(moment_of(fields).time_since_epoch().count(), 4'265'308'799);
}

TEST(CalendarTime, AMomentComesBackAsItWas) {
  for (const sys_seconds moment :
       {at(1950y / January / 1, 0s), at(1970y / January / 1, 0s), at(2000y / February / 29, 43200s),
        at(2038y / January / 19, 11648s), at(2045y / July / 1, 1s),
        at(2105y / December / 31, 86399s), at(9999y / December / 31, 86399s)}) {
    EXPECT_EQ(moment_of(calendar_time(moment)), moment);
  }
}

TEST(CalendarTime, FieldsBeyondTheirRangesAreCarriedOver) {
  std::tm fields = calendar_time(at(2045y / December / 31, 0s));
  fields.tm_sec = 86400;
  EXPECT_EQ(moment_of(fields), at(2046y / January / 1, 0s));
  fields.tm_sec = 0;
  fields.tm_mon += 1;
  EXPECT_EQ(moment_of(fields), at(2046y / January / 31, 0s));
}

}  // namespace
}  // namespace orbwatch::hal
