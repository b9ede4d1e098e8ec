// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/watched_input.h"

#include <gmock/gmock.h>

#include "hal/lines/simulated_lines.h"
#include "tests/hal/lines/edges.h"

namespace orbwatch::hal {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;

class WatchedInputTest : public testing::Test {
 protected:
  std::unique_ptr<WatchedInput> open(Clock::duration debounce) {
    InputSettings settings{.address = {.name = "IN"}};
    settings.debounce = debounce;
    auto input = std::make_unique<WatchedInput>(
        lines, settings, [this](const LineFaultReport& report) { faults.push_back(report.fault); },
        at(0));
    input->subscribe([this](const EdgeEvent& edge) { heard.push_back(edge); });
    return input;
  }

  /// Runs the work that is due within half a second after `now`.
  static void settle(WatchedInput& input, double now) {
    input.run(at(now));
    while (input.due() < at(now + 500)) input.run(input.due());
  }

  SimulatedLines lines{{"IN"}};
  std::vector<EdgeEvent> heard;
  std::vector<LineFault> faults;
};

TEST_F(WatchedInputTest, AStormEndsWithTheRightLevel) {
  const auto input = open(milliseconds(2));
  for (int i = 0; i < 101; ++i) lines.drive("IN", i % 2 == 0, at(i * 0.01));
  input->read(at(1.1));
  EXPECT_THAT(heard, ElementsAre());
  settle(*input, 20);
  ASSERT_EQ(heard.size(), 1U) << "the queue kept 16 of 101 edges, and the last one was falling";
  EXPECT_EQ(heard[0].edge, Edge::Rising);
  EXPECT_GE(input->lost(), 1U);
}

TEST_F(WatchedInputTest, WithoutDebounceALostLastEdgeIsMadeUpFor) {
  const auto input = open(Clock::duration(0));
  for (int i = 0; i < 17; ++i) lines.drive("IN", i % 2 == 0, at(i));
  input->read(at(20));
  EXPECT_EQ(heard.size(), SimulatedLines::kQueue);
  settle(*input, 20);
  ASSERT_EQ(heard.size(), 17U);
  EXPECT_EQ(heard.back().edge, Edge::Rising);
  EXPECT_EQ(input->lost(), 1U);
}

TEST_F(WatchedInputTest, WithoutDebounceALostEdgeIsMadeUpForOnABusyLine) {
  const auto input = open(Clock::duration(0));
  for (int i = 0; i < 17; ++i) lines.drive("IN", i % 2 == 0, at(i * 0.01));
  input->read(at(1));
  for (int i = 0; i < 2; ++i) {  // still inverted: two more readings are needed
    lines.drive("IN", i % 2 == 1, at(2 + i));
    input->read(at(2 + i));
  }
  for (int i = 0; i < 20; ++i) {
    lines.drive("IN", i % 2 == 1, at(4 + i));
    input->read(at(4 + i));
    EXPECT_EQ(heard.back(), (EdgeEvent{edge_to(i % 2 == 1), at(4 + i)}));
  }
  EXPECT_EQ(input->lost(), 1U);
}

TEST_F(WatchedInputTest, ALineThatGoesSilentlyIsNoticed) {
  const auto input = open(Clock::duration(0));
  input->run(at(0));
  lines.fail_with("IN", LineFault::Gone);
  EXPECT_EQ(input->due(), at(1000));
  input->run(at(1000));
  EXPECT_THAT(faults, ElementsAre(LineFault::Gone));
}

TEST_F(WatchedInputTest, ALineThatIsNotThereIsTakenUpWhenItComes) {
  lines.fail_with("IN", LineFault::Gone);
  const auto input = open(Clock::duration(0));
  EXPECT_THAT(faults, ElementsAre(LineFault::Gone));
  EXPECT_EQ(input->state()->active(), std::nullopt) << "nobody knows";
  lines.drive("IN", true, at(0));
  lines.fail_with("IN", LineFault::None);
  EXPECT_EQ(input->due(), at(1000));
  input->run(at(1000));
  EXPECT_THAT(faults, ElementsAre(LineFault::Gone, LineFault::None));
  EXPECT_EQ(input->state()->active(), true);
  EXPECT_THAT(heard, ElementsAre()) << "its first level is no edge";
  lines.drive("IN", false, at(1001));
  input->read(at(1001));
  EXPECT_THAT(heard, ElementsAre(EdgeEvent{Edge::Falling, at(1001)}));
  EXPECT_EQ(input->state()->active(), false);
}

TEST_F(WatchedInputTest, TheStateOfALineThatFailsIsNotKnown) {
  const auto input = open(Clock::duration(0));
  lines.drive("IN", true, at(0));
  input->read(at(0));
  EXPECT_EQ(input->state()->active(), true);
  lines.fail_with("IN", LineFault::ReadError);
  input->read(at(1));
  EXPECT_EQ(input->state()->active(), std::nullopt);
  lines.fail_with("IN", LineFault::None);
  input->run(input->due());
  EXPECT_EQ(input->state()->active(), true) << "without an edge, too";
}

TEST_F(WatchedInputTest, CountsActiveEdgesOfShortPulsesToo) {
  const auto input = open(Clock::duration(0));
  for (int i = 0; i < 6; ++i) lines.drive("IN", i % 2 == 0, at(i));
  input->read(at(6));
  EXPECT_EQ(input->state()->active(), false);
  EXPECT_EQ(input->state()->edges(), 3U);
  lines.fail_with("IN", LineFault::ReadError);
  input->read(at(7));
  lines.drive("IN", true, at(8));
  lines.fail_with("IN", LineFault::None);
  input->run(input->due());
  EXPECT_EQ(input->state()->active(), true);
  EXPECT_EQ(input->state()->edges(), 3U) << "an input that becomes known is no edge";
}

TEST_F(WatchedInputTest, ALineThatGoesIsReportedOnceAndOpenedAgain) {
  const auto input = open(Clock::duration(0));
  lines.fail_with("IN", LineFault::Gone);
  input->read(at(0));
  EXPECT_THAT(faults, ElementsAre(LineFault::Gone));
  EXPECT_EQ(input->descriptor(), -1);
  std::vector<double> retries;
  for (int i = 0; i < 6; ++i) {
    const std::chrono::duration<double> due = input->due() - at(0);
    retries.push_back(due.count());
    input->run(input->due());
  }
  EXPECT_THAT(retries, ElementsAre(1, 3, 5, 7, 9, 11)) << "after 1, 2, 2, ... s";
  lines.drive("IN", true, at(0));
  lines.fail_with("IN", LineFault::None);
  const TimePoint back = input->due();
  input->run(back);
  EXPECT_THAT(faults, ElementsAre(LineFault::Gone, LineFault::None));
  EXPECT_THAT(heard, ElementsAre(EdgeEvent{Edge::Rising, back})) << "what changed meanwhile";
  EXPECT_EQ(input->opened(), 2U);
  lines.drive("IN", false, back + milliseconds(1));
  input->read(back + milliseconds(1));
  EXPECT_EQ(heard.back(), (EdgeEvent{Edge::Falling, back + milliseconds(1)}));
}

}  // namespace
}  // namespace orbwatch::hal
