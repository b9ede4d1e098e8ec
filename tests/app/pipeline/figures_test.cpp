// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "app/pipeline/frame_budget.h"
#include "app/pipeline/second_meter.h"

namespace orbwatch::app::pipeline {
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

constexpr milliseconds kDeadline{100}, kOverrun{101}, kCalm{49}, kJustInTime{51};

TEST(FrameBudget, HalvesDisplayViewsAfterAnOverrunDownToEveryEighth) {
  FrameBudget budget(kDeadline);
  EXPECT_TRUE(budget.is_display_due(1));
  for (const std::uint64_t interval : {2, 4, 8, 8}) {
    EXPECT_TRUE(budget.add(kOverrun));
    EXPECT_EQ(budget.interval(), interval);
  }
  EXPECT_FALSE(budget.is_display_due(1));
  EXPECT_TRUE(budget.is_display_due(8));
  EXPECT_EQ(budget.overruns(), 4U);
}

TEST(FrameBudget, ComesBackAfterACalmSecondOnly) {
  FrameBudget budget(kDeadline);
  budget.add(kOverrun);
  budget.add(kOverrun);
  for (int i = 0; i < 9; ++i) EXPECT_FALSE(budget.add(kCalm));
  EXPECT_EQ(budget.interval(), 4U);
  budget.add(kCalm);
  EXPECT_EQ(budget.interval(), 2U);
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(budget.add(kJustInTime));
  EXPECT_EQ(budget.interval(), 2U) << "just in time is not calm";
}

TEST(FrameBudget, JudgesByTheDeadlineOfThePresent) {
  FrameBudget budget(kDeadline);
  budget.set_deadline(kCalm);
  EXPECT_TRUE(budget.add(kJustInTime));
  budget.set_deadline(kDeadline);
  EXPECT_FALSE(budget.add(kJustInTime));
  EXPECT_EQ(budget.overruns(), 1U);
}

TEST(FrameBudget, ReportsTheLargestLoadSinceTheLastReport) {
  FrameBudget budget(kDeadline);
  for (const milliseconds spent : {kCalm, kOverrun, kJustInTime}) budget.add(spent);
  EXPECT_NEAR(budget.roll_load(), 1.01, 1e-9);
  EXPECT_EQ(budget.roll_load(), 0);
}

}  // namespace
}  // namespace orbwatch::app::pipeline
