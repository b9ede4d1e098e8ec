// SPDX-License-Identifier: Apache-2.0
#include "hal/libcamera/libcamera_camera.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace orbwatch::hal {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr const char* kMissing = "no-such-camera";

std::string configure_error(LibcameraSettings settings, const StreamRequest& request = {}) {
  LibcameraCamera camera(std::move(settings));
  const auto format = camera.configure(request);
  EXPECT_FALSE(camera.start([](const Frame&) {}, [](const FaultReport&) {}));
  return format ? std::string() : format.error().message;
}

TEST(LibcameraCamera, SaysWhichCameraIsMissingAndWhatThereIs) {
  EXPECT_THAT(configure_error({.camera = kMissing}),
              AllOf(HasSubstr(kMissing), HasSubstr("is not there; there are: ")));
  LibcameraCamera camera({.camera = kMissing});
  EXPECT_EQ(camera.info().id, kMissing);
  EXPECT_EQ(camera.info().model, "unknown");
  EXPECT_EQ(camera.info().back_end, "libcamera");
}

TEST(LibcameraCamera, ListsThePixelFormatsThereAre) {
  EXPECT_THAT(configure_error({.camera = kMissing, .pixel_format = "h264"}),
              AllOf(HasSubstr("h264"), HasSubstr("auto, NV12, "), HasSubstr("BGR888")));
}

TEST(LibcameraCamera, RefusesSenselessRequestsBeforeItLooksForTheCamera) {
  const LibcameraSettings settings{.camera = kMissing};
  EXPECT_THAT(configure_error(settings, {.width = -640, .height = 480}), HasSubstr("-640x480"));
  EXPECT_THAT(configure_error(settings, {.width = 20000, .height = 480}), HasSubstr("16384"));
  EXPECT_THAT(configure_error(settings, {.frame_rate = -1}), HasSubstr("frames per second"));
  EXPECT_THAT(configure_error(settings, {.frame_rate = std::numeric_limits<double>::quiet_NaN()}),
              HasSubstr("frames per second"));
  EXPECT_THAT(configure_error({.camera = kMissing, .sensor_mode = {1920, 0, 10}}),
              HasSubstr("sensor mode 1920x0 10 bit"));
}

TEST(LibcameraCamera, CannotSetAControlOfAMissingCamera) {
  LibcameraCamera camera({.camera = kMissing});
  const auto done = camera.set("ExposureTime", 1000);
  ASSERT_FALSE(done);
  EXPECT_THAT(done.error().message, HasSubstr(kMissing));
}

TEST(LibcameraCamera, HasNoSoftwareTrigger) {
  LibcameraCamera camera({.camera = kMissing});
  EXPECT_FALSE(camera.trigger());
}

}  // namespace
}  // namespace orbwatch::hal
