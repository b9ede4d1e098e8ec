// SPDX-License-Identifier: Apache-2.0
#include "app/ports/web/access/audit/repetitions.h"

#include <gtest/gtest.h>

namespace orbwatch::app::web::tests {
namespace {

using std::chrono::minutes;
using std::chrono::seconds;

const Repetitions::Time kFirstTime{seconds(1'800'000'000)};

AuditEntry turned(int before, int after, Repetitions::Time time = kFirstTime) {
  return {time,  "kim", "10.0.0.1", "point_view", std::to_string(before), std::to_string(after),
          "done"};
}

TEST(Repetitions, TheFirstAreNotedAndTheRestIsCounted) {
  Repetitions repetitions(3, 10);
  for (int i = 0; i < 10; ++i) {
    const auto counted = repetitions.count("kim", turned(i, i + 1));
    EXPECT_EQ(counted.is_noted, i < 3);
    EXPECT_EQ(counted.count, static_cast<std::uint64_t>(i) + 1);
  }
  EXPECT_TRUE(repetitions.count("lee", turned(0, 1)).is_noted) << "another kind";
  EXPECT_TRUE(repetitions.take_due(kFirstTime + minutes(9)).empty());
  const auto due = repetitions.take_due(kFirstTime + minutes(10));
  ASSERT_EQ(due.size(), 1U);
  EXPECT_EQ(due[0].before, "3");
  EXPECT_EQ(due[0].after, "10");
  EXPECT_EQ(due[0].result, "done, 7 more");
  EXPECT_EQ(due[0].from, "10.0.0.1");
  EXPECT_TRUE(repetitions.take_due(kFirstTime + minutes(20)).empty());
}

TEST(Repetitions, AfterAnHourTheFirstAreNotedAgain) {
  Repetitions repetitions(1, 10);
  EXPECT_TRUE(repetitions.count("kim", turned(0, 1)).is_noted);
  EXPECT_FALSE(repetitions.count("kim", turned(1, 2, kFirstTime + minutes(59))).is_noted);
  EXPECT_EQ(repetitions.take_all().size(), 1U);
  EXPECT_FALSE(repetitions.count("kim", turned(1, 2, kFirstTime + minutes(59))).is_noted)
      << "a look at the counts changes nothing";
  EXPECT_FALSE(repetitions.count("kim", turned(2, 3, kFirstTime + minutes(60))).is_noted)
      << "what was counted before comes first";
  EXPECT_EQ(repetitions.take_all().at(0).result, "done, 2 more");
  EXPECT_FALSE(repetitions.count("kim", turned(3, 4, kFirstTime + minutes(61))).is_noted);
  EXPECT_FALSE(repetitions.count("kim", turned(4, 5, kFirstTime + minutes(5))).is_noted)
      << "the clock was set back a little";
  EXPECT_EQ(repetitions.take_all().size(), 1U);
  EXPECT_TRUE(repetitions.count("kim", turned(5, 6, kFirstTime - minutes(600))).is_noted);
}

TEST(Repetitions, ManyKindsAreCountedAsOne) {
  Repetitions repetitions(1, 10);
  int noted = 0;
  for (int i = 0; i < 1000; ++i) {
    noted += repetitions.count("address " + std::to_string(i), turned(0, 1)).is_noted ? 1 : 0;
  }
  EXPECT_EQ(noted, 11);
  const auto counts = repetitions.take_all();
  ASSERT_EQ(counts.size(), 1U);
  EXPECT_EQ(counts[0].from, "(others)");
  EXPECT_EQ(counts[0].result, "done, 989 more");
  EXPECT_TRUE(repetitions.take_due(kFirstTime + minutes(60)).empty());
  EXPECT_TRUE(repetitions.count("address 999", turned(0, 1, kFirstTime + minutes(60))).is_noted)
      << "forgotten";
}

}  // namespace
}  // namespace orbwatch::app::web::tests
