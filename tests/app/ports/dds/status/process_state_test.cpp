// SPDX-License-Identifier: Apache-2.0
#include "app/ports/dds/status/process_state.h"

#include <gtest/gtest.h>

#include "tests/app/ports/dds/figures.h"
#include "tests/app/ports/dds/test_status.h"

namespace orbwatch::app::dds {
namespace {

using tests::of_kind;
using tests::value;

class ProcessStateComposerTest : public testing::Test {
 protected:
  const ProcessStateMessage& compose(const CommandCounts& commands = {}) {
    return composer_.compose({status_, names_, now_, stamp_}, commands);
  }

  Status status_ = tests::make_status();
  StatusNames names_ = tests::make_names();
  hal::TimePoint now_ = hal::Clock::now();
  std::chrono::system_clock::time_point stamp_;
  ProcessStateComposer composer_;
};

TEST_F(ProcessStateComposerTest, EverySignalAndHealthFigureIsAFigure) {
  const auto& message = compose();
  const auto regions = of_kind(message, "region");
  ASSERT_EQ(regions.size(), 2u);
  for (const signals::SignalInfo& info : signals::kSignals) {
    for (std::size_t i = 0; i < regions.size(); ++i) {
      const FigureMessage figure = tests::figure(regions[i].figures, info.name);
      EXPECT_EQ(figure.value, status_.regions[i].signals.*info.member) << info.name;
      EXPECT_EQ(figure.unit, info.unit) << info.name;
    }
  }
  const auto health = of_kind(message, "health");
  ASSERT_EQ(health.size(), 1u);
  for (const HealthField& info : kHealthFigures) {
    EXPECT_EQ(value(health[0], info.name), status_.health.*info.get) << info.name;
  }
}

TEST_F(ProcessStateComposerTest, SaysWhatTheStatusDoes) {
  const auto& message = compose({1, 2, 3, 4});
  std::vector<ComponentReadings> actual;
  for (std::uint32_t i = 0; i < message.components._length; ++i) {
    const ComponentMessage& component = message.components._buffer[i];
    actual.push_back({{component.kind, component.name}, {}});
    for (std::uint32_t j = 0; j < component.figures._length; ++j) {
      const FigureMessage& figure = component.figures._buffer[j];
      actual.back().readings.push_back({figure.name, figure.value, figure.unit, figure.text});
    }
  }
  auto expected = status_readings({status_, names_, now_, stamp_});
  expected.push_back(
      {{"commands"}, {{"done", 1}, {"refused", 2}, {"repeated", 3}, {"dropped", 4}}});
  tests::expect_same(actual, expected);
  EXPECT_EQ(message.frame_set, status_.frame_set);
  EXPECT_EQ(message.trigger, status_.trigger);
  EXPECT_EQ(message.result, status_.result);
  EXPECT_EQ(message.recipe, tests::kRecipe);
  EXPECT_EQ(message.configuration_checksum, 0xdeadbeef);
  EXPECT_EQ(message.system_state, 2);
  EXPECT_EQ(message.heartbeat, status_.heartbeat);
}

TEST_F(ProcessStateComposerTest, ListsComponentsByName) {
  status_.camera_count = 3;
  stamp_ = std::chrono::system_clock::time_point(std::chrono::nanoseconds(12'000'000'034));
  status_.cameras[2].last_frame = now_ - std::chrono::milliseconds(7500);
  const auto& message = compose({1, 2, 3, 4});
  EXPECT_EQ(message.header.stamp.sec, 12);
  EXPECT_EQ(message.header.stamp.nanosec, 34u);
  EXPECT_STREQ(message.header.frame_id, "");
  const auto cameras = of_kind(message, "camera");
  ASSERT_EQ(cameras.size(), 3u);
  EXPECT_STREQ(cameras[1].name, "thermal");
  EXPECT_STREQ(cameras[2].name, "3") << "has none";
  EXPECT_EQ(value(cameras[2], "frames"), static_cast<double>(status_.cameras[2].frames));
  EXPECT_EQ(value(cameras[2], "last_frame_age"), 7.5);
  const auto views = of_kind(message, "view");
  ASSERT_EQ(views.size(), 2u);
  EXPECT_STREQ(views[1].name, "wide");
  EXPECT_STREQ(of_kind(message, "region").at(1).name, "edge");
  EXPECT_EQ(value(of_kind(message, "commands").at(0), "dropped"), 4);
  EXPECT_STREQ(of_kind(message, "commands").at(0).name, "");
}

TEST_F(ProcessStateComposerTest, RegionsAreNamedByTheirRecipe) {
  names_ = {{}, {}, {{1, {"weld"}}, {2, {"bead", "rim"}}}};
  status_.recipe = 2;
  EXPECT_STREQ(of_kind(compose(), "region").at(1).name, "rim");
  status_.recipe = 1;
  EXPECT_STREQ(of_kind(compose(), "region").at(0).name, "weld");
  EXPECT_STREQ(of_kind(compose(), "region").at(1).name, "2");
  status_.recipe = 9;
  EXPECT_STREQ(of_kind(compose(), "region").at(0).name, "1");
}

TEST_F(ProcessStateComposerTest, CountsBeyondTheArraysAreCut) {
  status_.camera_count = status_.view_count = status_.region_count = status_.alarm_count = 1000;
  status_.alarms[5].signal = static_cast<SignalNumber>(1000);
  const auto& message = compose();
  EXPECT_EQ(of_kind(message, "camera").size(), kMaxCameras);
  EXPECT_EQ(of_kind(message, "view").size(), kMaxViews);
  EXPECT_EQ(of_kind(message, "region").size(), signals::kMaxRegions);
  EXPECT_EQ(of_kind(message, "alarm").size(), signals::kMaxAlarms);
}

TEST_F(ProcessStateComposerTest, MemoryIsReused) {
  compose();
  status_.region_count = status_.camera_count = 0;
  const auto& fewer = compose();
  EXPECT_TRUE(of_kind(fewer, "region").empty());
  EXPECT_EQ(of_kind(fewer, "view").size(), 2u);
  status_.region_count = 4;
  EXPECT_EQ(of_kind(compose(), "region").size(), 4u);
}

}  // namespace
}  // namespace orbwatch::app::dds
