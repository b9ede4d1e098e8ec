// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <linux/videodev2.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tests/hal/v4l2/drivers/camera_run.h"
#include "tests/hal/v4l2/fake_device.h"

/// A camera that an earlier configuration left waiting for triggers.
namespace orbwatch::hal {
namespace {

void draw_black(std::span<std::uint16_t> words, std::size_t) { std::ranges::fill(words, 0); }

class LeftWaiting : public testing::Test {
 protected:
  LeftWaiting() {
    tests::connect(
        {.fourcc = V4L2_PIX_FMT_Y16, .sizes = {{160, 120}}, .draw = draw_black, .trigger_mode = 1});
  }

  const V4l2Settings settings_{.device = tests::kFakeDevice, .pixel_format = "y16"};
};

TEST_F(LeftWaiting, RunsFreelyWithoutTheControl) {
  CameraRun run(settings_);
  ASSERT_TRUE(run.start({}));
  EXPECT_EQ(tests::trigger_mode(), 0);
  EXPECT_TRUE(run.next_frame());
}

TEST_F(LeftWaiting, WaitsOnWhereTriggersAreUsed) {
  CameraRun run(settings_);
  ASSERT_TRUE(run.camera().configure({.is_triggered = true}));
  EXPECT_EQ(tests::trigger_mode(), 1) << "a device may be set by its maker's program";
}

TEST_F(LeftWaiting, WaitsWithTheControl) {
  CameraRun run(settings_, {{"TriggerMode", 1}});
  ASSERT_TRUE(run.camera().configure({}));
  EXPECT_EQ(tests::trigger_mode(), 1);
}

}  // namespace
}  // namespace orbwatch::hal
