// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "tests/hal/v4l2/drivers/camera_run.h"
#include "tests/hal/v4l2/drivers/vivid_device.h"

/// Properties that vivid reports of itself and of its frames.
namespace orbwatch::hal {
namespace {

using testing::AllOf;
using testing::AnyOf;
using testing::Contains;
using testing::Field;
using testing::HasSubstr;

CameraEntry listed_vivid() {
  for (const CameraEntry& camera : list_v4l2_cameras()) {
    if (camera.bus == kVivid) return camera;
  }
  ADD_FAILURE() << "vivid is not listed";
  return {};
}

TEST(VividList, HasDriverModelBusAndStablePath) {
  const CameraEntry vivid = listed_vivid();
  EXPECT_EQ(vivid.driver, "vivid");
  EXPECT_EQ(vivid.model, "vivid");
  EXPECT_EQ(vivid.problem, "");
  EXPECT_THAT(vivid.id, HasSubstr("/dev/v4l/by-path/"));
  ASSERT_EQ(vivid.paths.size(), 2U);
  EXPECT_EQ(vivid.paths[0], vivid.id);
  EXPECT_THAT(vivid.paths[1], HasSubstr("/dev/video"));
  const std::string link = std::filesystem::path(vivid.id).filename();
  EXPECT_EQ(find_v4l2_device(link).value(), vivid.id);
  EXPECT_TRUE(V4l2Device::open(vivid.id));
}

TEST(VividList, HasFormatsWithSizesAndRates) {
  const CameraEntry vivid = listed_vivid();
  EXPECT_THAT(vivid.modes, Contains(AllOf(Field(&CameraMode::format, "yuyv"),
                                          Field(&CameraMode::size, "320x180"),
                                          Field(&CameraMode::frame_rates, Contains(60.0)))));
  EXPECT_THAT(vivid.modes, Contains(Field(&CameraMode::format, "y16_be")));
}

TEST(VividList, HasControlsWithRangesAndMenus) {
  const CameraEntry vivid = describe(open_vivid());
  const auto control = [&vivid](const char* name) {
    const auto found = std::find_if(vivid.controls.begin(), vivid.controls.end(),
                                    [name](const CameraControl& c) { return c.name == name; });
    EXPECT_NE(found, vivid.controls.end()) << name;
    return found == vivid.controls.end() ? CameraControl() : *found;
  };
  const CameraControl brightness = control("brightness");
  EXPECT_EQ(brightness.minimum, 0);
  EXPECT_EQ(brightness.maximum, 255);
  EXPECT_EQ(brightness.default_value, 128);
  EXPECT_TRUE(brightness.values.empty());
  EXPECT_THAT(control("test_pattern").values, Contains("1 = 100% Colorbar"));
  EXPECT_EQ(control("read_only_integer_32_bits").state, "read only");
}

TEST(VividControls, AreSetByAnySpellingAndRefusedOutsideTheirRange) {
  V4l2Device device = open_vivid();
  EXPECT_TRUE(set_control(device, "OSD Text Mode", 0));
  EXPECT_TRUE(set_control(device, "OsdTextMode", 0));
  ASSERT_TRUE(set_control(device, "GainAuto", 1));
  const auto automatic = set_control(device, "Gain", 100);
  ASSERT_FALSE(automatic);
  EXPECT_THAT(automatic.error().message, HasSubstr("automatic control"));
  ASSERT_TRUE(set_control(device, "GainAuto", 0));
  EXPECT_TRUE(set_control(device, "Gain", 100));
  const auto large = set_control(device, "Gain", 256);
  ASSERT_FALSE(large);
  EXPECT_THAT(large.error().message, HasSubstr("it takes 0 to 255"));
  EXPECT_FALSE(set_control(device, "read_only_integer_32_bits", 0));
  const auto unknown = set_control(device, "warp", 1);
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, HasSubstr("brightness"));
}

TEST(VividFrames, AreNumberedAndStampedAndSayWhatTheStampTells) {
  // Menu of vivid: 0 the end of the frame, 1 the start of its exposure. It stamps the end of the
  // frame in advance; such a stamp is plausible only when the frame is dequeued later than that.
  const std::array sources{AnyOf(StampSource::Arrival, StampSource::FrameEnd),
                           AnyOf(StampSource::ExposureStart, StampSource::ExposureStart)};
  for (const std::size_t menu : {0U, 1U}) {
    CameraRun run({kVivid, "grey", true}, {{"timestamp_source", static_cast<double>(menu)}});
    ASSERT_TRUE(run.start(kVividRequest));
    Frame last;
    for (int n = 0; n < 5; ++n) {
      const Frame frame = run.next_frame();
      ASSERT_TRUE(frame);
      EXPECT_THAT(frame->metadata.stamp_source, sources[menu]);
      EXPECT_LE(frame->metadata.exposure_start, Clock::now());
      if (last) {
        EXPECT_GT(frame->metadata.sequence, last->metadata.sequence);
        EXPECT_GT(frame->metadata.exposure_start, last->metadata.exposure_start);
      }
      last = frame;
    }
  }
}

}  // namespace
}  // namespace orbwatch::hal
