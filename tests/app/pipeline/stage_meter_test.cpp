// SPDX-License-Identifier: Apache-2.0
#include "app/pipeline/stage_meter.h"

#include <gtest/gtest.h>

#include <numeric>

namespace orbwatch::app::pipeline {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

const StageStatus& of(const Status& status, Stage stage) {
  return status.stages[static_cast<std::size_t>(stage)];
}

/// Time far above the calls in between.
constexpr milliseconds kHelped{5000};

TEST(StageMeter, AddsWhatOthersDidToTheStage) {
  StageMeter meter;
  meter.begin();
  meter.end(Stage::Halving, kHelped);
  meter.end(Stage::Views, 2 * kHelped);
  meter.end(Stage::Views, kHelped);
  meter.end_set({}, {});
  Status status;
  meter.report(status);
  EXPECT_NEAR(of(status, Stage::Halving).cpu_ms, 5000, 1000);
  EXPECT_NEAR(of(status, Stage::Views).cpu_ms, 15000, 1000);
  EXPECT_LT(of(status, Stage::Measurement).cpu_ms, 1000);
  EXPECT_LT(status.busy_ms, 1000) << "only of its own thread";
  meter.end_set({}, {});
  meter.report(status);
  EXPECT_EQ(of(status, Stage::Views).cpu_ms, 0) << "of the newest set";
}

TEST(StageMeter, CountsThePipelinesThreadCompletely) {
  StageMeter meter;
  meter.begin();
  meter.end(Stage::Publication);
  meter.end_set({}, {});
  volatile int work = 0;
  while (work < 1'000'000) work = work + 1;
  meter.end(Stage::Measurement);
  meter.end_set({}, {});
  Status status;
  meter.report(status);
  EXPECT_GT(of(status, Stage::Measurement).cpu_ms, 0);
  EXPECT_DOUBLE_EQ(of(status, Stage::Measurement).cpu_ms, status.busy_ms);
}

TEST(StageMeter, TakesTheGrowthOfThreadsThatRunByThemselves) {
  StageMeter meter;
  Status status;
  for (const int set : {1, 2, 3}) {
    meter.end_set(milliseconds(7 * set), milliseconds(20 + set));
    meter.report(status);
    EXPECT_NEAR(of(status, Stage::Capture).cpu_ms, 7, 1e-9);
    EXPECT_NEAR(of(status, Stage::Sinks).cpu_ms, set == 1 ? 21 : 1, 1e-9);
  }
  meter.end_set(milliseconds(3), milliseconds(30));  // a thread has just ended
  meter.report(status);
  EXPECT_EQ(of(status, Stage::Capture).cpu_ms, 0);
  meter.end_set(milliseconds(25), milliseconds(30));
  meter.report(status);
  EXPECT_NEAR(of(status, Stage::Capture).cpu_ms, 4, 1e-9) << "nothing is counted twice";
}

TEST(StageMeter, RanksTheSetsOfASecond) {
  StageMeter meter;
  nanoseconds capture{0};
  for (int set = 1; set <= 100; ++set) {
    capture += milliseconds(set);
    meter.end_set(capture, {});
  }
  Status status;
  meter.roll(std::chrono::seconds(1), status);
  EXPECT_NEAR(of(status, Stage::Capture).cpu_p50_ms, 50, 1);
  EXPECT_NEAR(of(status, Stage::Capture).cpu_p99_ms, 99, 1);
  meter.roll(std::chrono::seconds(1), status);
  EXPECT_EQ(of(status, Stage::Capture).cpu_p99_ms, 0);
}

}  // namespace
}  // namespace orbwatch::app::pipeline
