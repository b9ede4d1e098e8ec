// SPDX-License-Identifier: Apache-2.0
#include "app/ports/recorder/events/ring_size.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace orbwatch::app::recorder {
namespace {

using std::chrono::seconds;
using testing::HasSubstr;

/// 1 MiB per picture, 10 a second.
RecordedCamera camera(const std::string& name) {
  RecordedCamera camera;
  camera.name = name;
  camera.format.format = PixelFormat::Y16;
  camera.format.width = camera.format.height = 2000;
  camera.format.frame_rate = 10;
  camera.ball = {100, 100, 1024, 512};
  return camera;
}

EventSettings settings(int ring_mib) {
  EventSettings settings;
  settings.ring_mib = ring_mib;
  settings.before = seconds(3);
  settings.after = seconds(2);
  return settings;
}

TEST(RingSize, ARingMustHoldBeforeAndAfterTogether) {
  const std::vector cameras{camera("left"), camera("right")};
  EXPECT_TRUE(check_ring(settings(100), cameras));
  const auto refused = check_ring(settings(99), cameras);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("ring_mib is 99"));
  EXPECT_THAT(refused.error().message, HasSubstr("need 100"));
}

TEST(RingSize, OnlyTheNamedCamerasCount) {
  EventSettings one = settings(50);
  one.cameras = {"right"};
  EXPECT_TRUE(check_ring(one, {camera("left"), camera("right")}));
  one.cameras = {"top"};
  const auto refused = check_ring(one, {camera("left")});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("there is no camera top"));
}

TEST(RingSize, DataOfAJpegCameraCountsAsAQuarterOfTheWholePicture) {
  RecordedCamera sends = camera("left");
  sends.format.format = PixelFormat::Nv12;
  sends.format.has_jpeg = true;
  EXPECT_TRUE(check_ring(settings(72), {sends}));
  EXPECT_FALSE(check_ring(settings(71), {sends}));
}

TEST(RingSize, APictureMustFitIntoARecording) {
  RecordedCamera large = camera("left");
  large.ball = {0, 0, 4096, 4096};
  const auto refused = check_ring(settings(65536), {large});
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().message, HasSubstr("a picture of left is larger than 31 MiB"));
}

TEST(RingSize, ACameraWhoseRateIsNotKnownDoesNotCount) {
  RecordedCamera unknown = camera("left");
  unknown.format.frame_rate = 0;
  EXPECT_TRUE(check_ring(settings(1), {unknown}));
}

}  // namespace
}  // namespace orbwatch::app::recorder
