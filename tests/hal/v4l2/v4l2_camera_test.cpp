// SPDX-License-Identifier: Apache-2.0
#include "hal/v4l2/v4l2_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace orbwatch::hal {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kMissing = "/dev/v4l/by-id/no-such-camera";

std::string configure_error(V4l2Settings settings, const StreamRequest& request = {}) {
  V4l2Camera camera(std::move(settings));
  const auto format = camera.configure(request);
  EXPECT_FALSE(camera.start([](const Frame&) {}, [](const FaultReport&) {}));
  return format ? std::string() : format.error().message;
}

TEST(V4l2Camera, SaysWhichDeviceIsMissing) {
  EXPECT_THAT(configure_error({.device = kMissing}),
              AllOf(HasSubstr(kMissing), HasSubstr("No such file")));
}

TEST(V4l2Camera, RefusesAFileThatIsNoCamera) {
  EXPECT_THAT(configure_error({.device = "/dev/null"}),
              AllOf(HasSubstr("/dev/null"), HasSubstr("not a V4L2 device")));
}

TEST(V4l2Camera, ListsThePixelFormatsThereAre) {
  EXPECT_THAT(configure_error({.device = kMissing, .pixel_format = "h264"}),
              AllOf(HasSubstr("h264"), HasSubstr("auto, yuyv, uyvy, nv12")));
}

TEST(V4l2Camera, RefusesSenselessRequestsBeforeItTouchesTheDevice) {
  const V4l2Settings settings{.device = kMissing};
  EXPECT_THAT(configure_error(settings, {.width = -640, .height = 480}), HasSubstr("-640x480"));
  EXPECT_THAT(configure_error(settings, {.width = 20000, .height = 480}), HasSubstr("16384"));
  EXPECT_THAT(configure_error(settings, {.frame_rate = -1}), HasSubstr("frames per second"));
  EXPECT_THAT(configure_error(settings, {.frame_rate = std::numeric_limits<double>::quiet_NaN()}),
              HasSubstr("frames per second"));
}

TEST(V4l2Camera, CannotSetAControlOfAMissingDevice) {
  V4l2Camera camera({.device = kMissing});
  EXPECT_EQ(camera.info().model, "unknown");
  const auto done = camera.set("ExposureTime", 1000);
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message, HasSubstr(kMissing));
}

}  // namespace
}  // namespace orbwatch::hal
