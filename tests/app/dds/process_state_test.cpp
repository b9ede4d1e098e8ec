#include "app/dds/process_state.h"

#include <gtest/gtest.h>

#include "tests/app/dds/test_status.h"

namespace orbwatch::app {
namespace {

TEST(ProcessStateComposerTest, EverySignalAndHealthFigureHasItsMember) {
  ProcessStateComposer composer(tests::make_names());
  const Status status = tests::make_status();
  const auto& message = composer.compose(status, {}, {});
  ASSERT_EQ(message.regions._length, 2u);
#define ORBWATCH_EXPECT(name, unit, scale, minimum, maximum, description)                      \
  EXPECT_EQ(message.regions._buffer[0].signals.name, status.regions[0].signals.name) << #name; \
  EXPECT_EQ(message.regions._buffer[1].signals.name, status.regions[1].signals.name) << #name;
  ORBWATCH_SIGNALS(ORBWATCH_EXPECT)
#undef ORBWATCH_EXPECT
#define ORBWATCH_EXPECT(name, unit, scale, minimum, maximum, description) \
  EXPECT_EQ(message.health.name, status.health.name) << #name;
  ORBWATCH_HEALTH(ORBWATCH_EXPECT)
#undef ORBWATCH_EXPECT
}

TEST(ProcessStateComposerTest, ListsWhatThereIsByName) {
  ProcessStateComposer composer(tests::make_names());
  Status status = tests::make_status();
  status.camera_count = 3;
  StatusTimes times;
  times.stamp = std::chrono::system_clock::time_point(std::chrono::nanoseconds(12'000'000'034));
  times.last_frame_age_s[2] = 7.5;
  const auto& message = composer.compose(status, times, {1, 2, 3, 4});
  EXPECT_EQ(message.stamp.sec, 12);
  EXPECT_EQ(message.stamp.nanosec, 34u);
  ASSERT_EQ(message.cameras._length, 3u);
  EXPECT_STREQ(message.cameras._buffer[1].name, "thermal");
  EXPECT_STREQ(message.cameras._buffer[2].name, "") << "has none";
  EXPECT_EQ(message.cameras._buffer[2].frames, status.cameras[2].frames);
  EXPECT_EQ(message.cameras._buffer[2].last_frame_age_s, 7.5);
  ASSERT_EQ(message.views._length, 2u);
  EXPECT_STREQ(message.views._buffer[1].name, "wide");
  EXPECT_STREQ(message.regions._buffer[1].name, "edge");
  EXPECT_EQ(message.commands.dropped, 4u);
}

TEST(ProcessStateComposerTest, RegionsAreNamedByTheirRecipe) {
  ProcessStateComposer composer({{}, {}, {{1, {"weld"}}, {2, {"bead", "rim"}}}});
  Status status = tests::make_status();
  status.recipe = 2;
  EXPECT_STREQ(composer.compose(status, {}, {}).regions._buffer[1].name, "rim");
  status.recipe = 1;
  EXPECT_STREQ(composer.compose(status, {}, {}).regions._buffer[0].name, "weld");
  EXPECT_STREQ(composer.compose(status, {}, {}).regions._buffer[1].name, "");
  status.recipe = 9;
  EXPECT_STREQ(composer.compose(status, {}, {}).regions._buffer[0].name, "");
}

TEST(ProcessStateComposerTest, CountsBeyondTheArraysAreCut) {
  ProcessStateComposer composer(tests::make_names());
  Status status = tests::make_status();
  status.camera_count = status.view_count = status.region_count = status.alarm_count = 1000;
  status.alarms[5].signal = 1000;
  const auto& message = composer.compose(status, {}, {});
  EXPECT_EQ(message.cameras._length, kMaxCameras);
  EXPECT_EQ(message.views._length, kMaxViews);
  EXPECT_EQ(message.regions._length, signals::kMaxRegions);
  EXPECT_EQ(message.alarms._length, signals::kMaxAlarms);
}

}  // namespace
}  // namespace orbwatch::app
