// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/event_signals.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "hal/recording/messages.h"
#include "tests/hal/recording/picture_file.h"
#include "tests/support/temporary_folder.h"

namespace orbwatch::app::recorder {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class Signals : public testing::Test {
 protected:
  /// Records `count` states: the nth, from 1, has components_of(n). The first three are by recipe
  /// 1, the others by recipe 2.
  template <class ComponentsOf>
  void record(std::uint64_t count, ComponentsOf components_of) const {
    tests::PictureFile file(recording_);
    const auto channel = file.add("/orbwatch/process_state", hal::recording::SetNumbers::kType);
    for (std::uint64_t n = 1; n <= count; ++n) {
      ProcessState state;
      state.frame_set = 100 + n;
      state.recipe = n > 3 ? 2 : 1;
      state.components = components_of(n);
      file.write(channel, n * 1'000'000'000, static_cast<std::uint32_t>(n), state);
    }
    file.finish();
  }
  RecordedCourse course(const std::string& region, const std::string& figure) {
    auto found = signals_.course(recording_, region, figure);
    EXPECT_TRUE(found) << found.error().message;
    return found ? *found : RecordedCourse();
  }

  const orbwatch::tests::TemporaryFolder folder_;
  const std::filesystem::path recording_ = folder_ / "a.mcap";
  EventSignals signals_;
};

TEST_F(Signals, HaveTheirValueInEachFrameSet) {
  const double none = std::nan("");
  record(3, [&](std::uint64_t n) -> std::vector<ComponentFigures> {
    const double width = n == 2 ? none : 0.5 * static_cast<double>(n);
    std::vector<ComponentFigures> all{
        {"system", "", {{"load", 1, "", ""}}},
        {"region", "pool", {{"width", width, "mm", ""}, {"area", none, "mm2", ""}}},
        {"machine", "", {{"part", none, "", "blade 7"}}}};
    if (n == 3) all.back().figures.push_back({"layer", 12, "", ""});
    return all;
  });
  const auto listed = signals_.list(recording_);
  ASSERT_TRUE(listed) << listed.error().message;
  ASSERT_EQ(listed->size(), 2U) << "neither the system's, nor one that is never a number";
  EXPECT_EQ(listed->front().region, "pool");
  EXPECT_EQ(listed->front().figure, "width");
  EXPECT_EQ(listed->front().unit, "mm");
  const RecordedCourse width = course("pool", "width");
  EXPECT_EQ(width.unit, "mm");
  EXPECT_THAT(width.frame_sets, ElementsAre(101, 102, 103));
  EXPECT_EQ(width.times.front(), "1970-01-01T00:00:01.000000000Z");
  EXPECT_THAT(width.low, ElementsAre(0.5, testing::IsNan(), 1.5));
  EXPECT_THAT(width.high, ElementsAre(0.5, testing::IsNan(), 1.5));
  EXPECT_THAT(course("", "layer").low, ElementsAre(testing::IsNan(), testing::IsNan(), 12));
}

TEST_F(Signals, OfALongEventHaveTheLowestAndTheHighestOfEachStep) {
  constexpr std::uint64_t kSets = 5000, kPeak = 3333;
  record(kSets, [](std::uint64_t n) -> std::vector<ComponentFigures> {
    const double width = n == kPeak ? 1e6 : static_cast<double>(n);
    return {{"region", "pool", {{"width", width, "mm", ""}}}};
  });
  const RecordedCourse width = course("pool", "width");
  ASSERT_EQ(width.low.size(), 1250U) << "steps of 4";
  ASSERT_EQ(width.high.size(), width.low.size());
  ASSERT_EQ(width.times.size(), width.low.size());
  EXPECT_EQ(width.frame_sets[1], 105U);
  EXPECT_EQ(width.low.front(), 1);
  EXPECT_EQ(width.high.front(), 4);
  EXPECT_EQ(width.low.back(), kSets - 3);
  EXPECT_EQ(width.high.back(), kSets);
  const std::size_t peak = (kPeak - 1) / 4;
  EXPECT_EQ(width.high[peak], 1e6) << "a single frame set is not lost";
  EXPECT_EQ(width.low[peak], 3334) << "of 3333 to 3336, the first of which has the peak";
}

TEST_F(Signals, HaveTheRecipesTheyWereMeasuredBy) {
  record(6, [](std::uint64_t) { return std::vector<ComponentFigures>(); });
  const auto changes = signals_.recipes(recording_);
  ASSERT_TRUE(changes) << changes.error().message;
  ASSERT_EQ(changes->size(), 2U);
  EXPECT_EQ(changes->front().recipe, 1);
  EXPECT_EQ(changes->front().time, "1970-01-01T00:00:01.000000000Z");
  EXPECT_EQ(changes->back().recipe, 2);
  EXPECT_EQ(changes->back().time, "1970-01-01T00:00:04.000000000Z");
}

TEST_F(Signals, AreThoseOfTheRecordingThatIsAskedFor) {
  const auto one = [](std::uint64_t) -> std::vector<ComponentFigures> {
    return {{"region", "pool", {{"width", 1, "mm", ""}}}};
  };
  record(2, one);
  EXPECT_EQ(course("pool", "width").low.size(), 2U);
  std::filesystem::copy_file(recording_, folder_ / "b.mcap");
  std::filesystem::remove(recording_);
  record(3, one);
  EXPECT_EQ(signals_.course(folder_ / "b.mcap", "pool", "width")->low.size(), 2U);
  EXPECT_EQ(course("pool", "width").low.size(), 3U);
  EXPECT_THAT(signals_.course(recording_, "seam", "width").error().message,
              HasSubstr("no signal width of the region seam"));
}

TEST_F(Signals, OfAHostileRecordingAreRefused) {
  EXPECT_FALSE(signals_.list(recording_)) << "no file";
  record(0, [](std::uint64_t) { return std::vector<ComponentFigures>(); });
  EXPECT_THAT(signals_.list(recording_).error().message, HasSubstr("no frame set"));
  std::filesystem::remove(recording_);
  record(1, [](std::uint64_t) -> std::vector<ComponentFigures> {
    std::vector<Figure> figures(513);
    for (std::size_t k = 0; k < figures.size(); ++k) figures[k].name = std::to_string(k);
    return {{"region", "pool", figures}};
  });
  EXPECT_THAT(signals_.list(recording_).error().message, HasSubstr("more than 512 signals"));
  std::filesystem::remove(recording_);
  record(1, [](std::uint64_t) -> std::vector<ComponentFigures> {
    return {{"region", std::string(2000, 'x'), {{"width", 1, "mm", ""}}}};
  });
  EXPECT_THAT(signals_.list(recording_).error().message, HasSubstr("longer than 1024 bytes"));
  std::filesystem::remove(recording_);
  record(1, [](std::uint64_t) -> std::vector<ComponentFigures> {
    return {{"region", "pool", {{"width", std::numeric_limits<double>::infinity(), "mm", ""}}}};
  });
  EXPECT_TRUE(signals_.list(recording_)->empty()) << "not a number that JSON has";
}

}  // namespace
}  // namespace orbwatch::app::recorder
