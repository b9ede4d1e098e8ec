// SPDX-License-Identifier: Apache-2.0
#include "hal/lines/pulse_output.h"

#include <gmock/gmock.h>

#include "tests/hal/lines/edges.h"
#include "tests/hal/lines/recorded_output.h"

namespace orbwatch::hal {
namespace {

using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::IsEmpty;

class PulseOutputTest : public testing::Test {
 protected:
  std::unique_ptr<PulseOutput> make(const PulseSettings& settings) {
    PulseOutput::Outputs outputs;
    for (const auto& record : records) outputs.push_back(std::make_unique<RecordedOutput>(record));
    return std::make_unique<PulseOutput>(settings, std::move(outputs), [this] { ++rings; });
  }

  void run(PulseOutput& output, double now) {
    for (const auto& record : records) record->now = at(now);
    output.run(at(now));
  }

  /// Runs the output like a line thread that is never late.
  void run_until(PulseOutput& output, double end) {
    while (output.due() <= at(end)) {
      const std::chrono::duration<double, std::milli> due = output.due() - at(0);
      run(output, due.count());
    }
  }

  std::vector<std::shared_ptr<RecordedOutput::Record>> records{
      std::make_shared<RecordedOutput::Record>(), std::make_shared<RecordedOutput::Record>()};
  int rings = 0;
};

TEST_F(PulseOutputTest, APulseOnCommandHasDelayAndWidthOnEveryLine) {
  const auto output = make({.delay = milliseconds(3), .width = milliseconds(2)});
  EXPECT_EQ(output->due(), TimePoint::max());
  EXPECT_TRUE(output->fire(at(10)));
  EXPECT_EQ(rings, 1);
  run(*output, 12.9);
  EXPECT_THAT(records[0]->changes, IsEmpty());
  run_until(*output, 100);
  for (const auto& record : records) {
    EXPECT_THAT(record->changes,
                ElementsAre(EdgeEvent{Edge::Rising, at(13)}, EdgeEvent{Edge::Falling, at(15)}));
  }
  EXPECT_EQ(output->counts().pulses, 1U);
}

TEST_F(PulseOutputTest, ACommandDuringAPulseIsMissed) {
  const auto output = make({.delay = milliseconds(1), .width = milliseconds(2)});
  EXPECT_TRUE(output->fire(at(10)));
  EXPECT_FALSE(output->fire(at(10.5))) << "waits for the first";
  run(*output, 11);
  EXPECT_FALSE(output->fire(at(12))) << "it is on";
  run_until(*output, 100);
  EXPECT_TRUE(output->fire(at(101)));
  EXPECT_EQ(output->counts().missed, 2U);
}

TEST_F(PulseOutputTest, ATrainStaysOnItsGrid) {
  const auto output =
      make({.period = milliseconds(10), .delay = milliseconds(4), .width = milliseconds(1)});
  run(*output, 100);
  run_until(*output, 104);
  run(*output, 105.5);  // late: the pulse is longer
  run(*output, 117);    // late: it begins later and has its normal length
  run_until(*output, 125);
  EXPECT_THAT(records[1]->changes,
              ElementsAre(EdgeEvent{Edge::Rising, at(104)}, EdgeEvent{Edge::Falling, at(105.5)},
                          EdgeEvent{Edge::Rising, at(117)}, EdgeEvent{Edge::Falling, at(118)},
                          EdgeEvent{Edge::Rising, at(124)}, EdgeEvent{Edge::Falling, at(125)}));
  EXPECT_EQ(output->counts().missed, 0U);
  EXPECT_FALSE(output->fire(at(130)));
}

TEST_F(PulseOutputTest, PulsesThatCameTooLateAreCountedNotCrammed) {
  const auto output = make({.period = milliseconds(10), .width = milliseconds(1)});
  run(*output, 100);
  run(*output, 101);
  run(*output, 137);  // the pulses at 110 and 120 are missed, that at 130 is late
  run_until(*output, 145);
  EXPECT_EQ(output->counts().pulses, 3U);
  EXPECT_EQ(output->counts().missed, 2U);
  EXPECT_EQ(records[0]->changes.back(), (EdgeEvent{Edge::Falling, at(141)}));
}

TEST_F(PulseOutputTest, ALineThatRefusesIsCountedAndTheOthersGoOn) {
  records[0]->is_broken = true;
  const auto output = make({.width = milliseconds(2)});
  output->fire(at(10));
  run_until(*output, 100);
  EXPECT_EQ(output->counts().failed, 2U);
  EXPECT_EQ(records[1]->changes.size(), 2U);
}

}  // namespace
}  // namespace orbwatch::hal
