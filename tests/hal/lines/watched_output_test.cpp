// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/watched_output.h"

#include <gmock/gmock.h>

#include "hal/lines/simulated_lines.h"
#include "tests/hal/lines/edges.h"

namespace orbwatch::hal {
namespace {

using testing::ElementsAre;

class WatchedOutputTest : public testing::Test {
 protected:
  std::unique_ptr<WatchedOutput> open() {
    return std::make_unique<WatchedOutput>(
        lines, OutputSettings{.address = {.name = "OUT"}},
        [this](const LineFaultReport& report) { faults.push_back(report.fault); }, at(0));
  }

  SimulatedLines lines{{"OUT"}};
  std::vector<LineFault> faults;
};

TEST_F(WatchedOutputTest, OneThatIsNotThereGetsItsLevelWhenItComes) {
  lines.fail_with("OUT", LineFault::Gone);
  const auto output = open();
  EXPECT_THAT(faults, ElementsAre(LineFault::Gone));
  EXPECT_FALSE(output->set(true));
  std::vector<double> attempts;
  for (int i = 0; i < 4; ++i) {
    const std::chrono::duration<double> due = output->due() - at(0);
    attempts.push_back(due.count());
    output->run(output->due());
  }
  EXPECT_THAT(attempts, ElementsAre(1, 3, 5, 7));
  lines.fail_with("OUT", LineFault::None);
  const TimePoint there = output->due();
  output->run(there);
  EXPECT_THAT(faults, ElementsAre(LineFault::Gone, LineFault::None));
  output->run(output->due());
  EXPECT_TRUE(lines.level("OUT"));
  EXPECT_TRUE(output->set(false));
  EXPECT_FALSE(lines.level("OUT"));
}

TEST_F(WatchedOutputTest, AHeldOneThatGoesIsNoticedAndSetAgain) {
  const auto output = open();
  ASSERT_TRUE(output->set(true));
  output->run(at(0));
  lines.fail_with("OUT", LineFault::Gone);
  EXPECT_EQ(output->due(), at(1000)) << "nobody sets it, so it is probed";
  output->run(at(1000));
  EXPECT_THAT(faults, ElementsAre(LineFault::Gone));
  EXPECT_FALSE(lines.level("OUT")) << "released";
  lines.fail_with("OUT", LineFault::None);
  output->run(output->due());
  output->run(output->due());
  EXPECT_TRUE(lines.level("OUT"));
}

}  // namespace
}  // namespace orbwatch::hal
