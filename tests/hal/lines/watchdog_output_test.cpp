// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/watchdog_output.h"

#include <gmock/gmock.h>

#include "tests/hal/lines/edges.h"
#include "tests/hal/lines/recorded_output.h"

namespace orbwatch::hal {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;

class WatchdogOutputTest : public testing::Test {
 protected:
  std::unique_ptr<WatchdogOutput> make(Clock::duration half_period) {
    return std::make_unique<WatchdogOutput>(WatchdogSettings{milliseconds(100), half_period},
                                            std::make_unique<RecordedOutput>(record),
                                            [this] { ++rings; });
  }

  /// Runs due work until `end`, reporting good health every 50 ms up to `last_report`.
  void live(WatchdogOutput& output, double begin, double last_report, double end) {
    double next = begin;
    for (double now = begin; now <= end; now += 1) {
      if (now >= next && now <= last_report) {
        output.report(true, at(now));
        next += 50;
      }
      record->now = at(now);
      if (output.due() <= at(now)) output.run(at(now));
    }
  }

  std::shared_ptr<RecordedOutput::Record> record = std::make_shared<RecordedOutput::Record>();
  int rings = 0;
};

TEST_F(WatchdogOutputTest, IsLowUntilTheFirstReport) {
  const auto output = make(Clock::duration(0));
  EXPECT_EQ(output->due(), TimePoint::max());
  output->run(at(1000));
  EXPECT_THAT(record->changes, IsEmpty());
}

TEST_F(WatchdogOutputTest, IsHeldWhileReportsComeAndFallsWithThem) {
  const auto output = make(Clock::duration(0));
  live(*output, 0, 500, 1000);
  EXPECT_THAT(record->changes,
              ElementsAre(EdgeEvent{Edge::Rising, at(0)}, EdgeEvent{Edge::Falling, at(601)}));
  EXPECT_EQ(rings, 1) << "reports of a known state wake nobody";
}

TEST_F(WatchdogOutputTest, FallsAtOnceOnABadReportAndComesBack) {
  const auto output = make(Clock::duration(0));
  live(*output, 0, 10, 10);
  output->report(false, at(11));
  EXPECT_EQ(rings, 2);
  EXPECT_LE(output->due(), at(11));
  live(*output, 11, 0, 11);
  EXPECT_EQ(record->changes.back(), (EdgeEvent{Edge::Falling, at(11)}));
  live(*output, 12, 12, 20);
  EXPECT_EQ(record->changes.back(), (EdgeEvent{Edge::Rising, at(12)}));
}

TEST_F(WatchdogOutputTest, TogglesWhileReportsComeAndEndsLow) {
  const auto output = make(milliseconds(20));
  live(*output, 0, 200, 1000);
  ASSERT_EQ(record->changes.size(), 16U) << "each 20 ms until 300";
  for (std::size_t i = 0; i < record->changes.size(); ++i) {
    EXPECT_EQ(record->changes[i], (EdgeEvent{edge_to(i % 2 == 0), at(20.0 * i)}));
  }
}

TEST_F(WatchdogOutputTest, ALineThatRefusesIsCounted) {
  const auto output = make(Clock::duration(0));
  record->is_broken = true;
  live(*output, 0, 0, 200);
  EXPECT_EQ(output->failed(), 2U);
}

}  // namespace
}  // namespace orbwatch::hal
