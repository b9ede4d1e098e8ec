#include "app/dds/process_state.h"

#include <gtest/gtest.h>

#include "tests/app/dds/test_status.h"

namespace orbwatch::app {
namespace {

TEST(ProcessStateComposerTest, EverySignalHasItsMember) {
  ProcessStateComposer composer({"front"});
  const Status status = tests::make_status();
  const auto& message = composer.compose(status, {});
#define ORBWATCH_EXPECT(name, unit, scale, minimum, maximum, description) \
  EXPECT_EQ(message.signals.name, status.signals.name);
  ORBWATCH_SIGNALS(ORBWATCH_EXPECT)
#undef ORBWATCH_EXPECT
}

TEST(ProcessStateComposerTest, ListsWhatThereIs) {
  ProcessStateComposer composer({"front", "wide"});
  Status status = tests::make_status();
  status.camera_count = 3;
  status.view_count = 2;
  const auto& message = composer.compose(status, {12, 34});
  EXPECT_EQ(message.stamp.sec, 12);
  EXPECT_EQ(message.stamp.nanosec, 34u);
  ASSERT_EQ(message.cameras._length, 3u);
  EXPECT_EQ(message.cameras._buffer[2].frames, status.cameras[2].frames);
  ASSERT_EQ(message.views._length, 2u);
  EXPECT_STREQ(message.views._buffer[1].name, "wide");
}

TEST(ProcessStateComposerTest, CountsBeyondTheArraysAreCut) {
  ProcessStateComposer composer({"front", "wide"});
  Status status = tests::make_status();
  status.camera_count = 1000;
  status.view_count = 1000;
  const auto& message = composer.compose(status, {});
  EXPECT_EQ(message.cameras._length, kMaxCameras);
  EXPECT_EQ(message.views._length, 2u);
}

}  // namespace
}  // namespace orbwatch::app
