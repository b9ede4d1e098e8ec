// SPDX-License-Identifier: Apache-2.0
#include "app/files/camera_edit.h"

#include <gmock/gmock.h>

namespace orbwatch::app::files {
namespace {

using testing::HasSubstr;

const std::string kTwoCameras = R"(# two cameras
[[camera]]
name = "a"
back_end = "genicam"
[camera.genicam]
camera = "SN-1"  # on the left

[[camera]]
name = "b"
back_end = "v4l2"
v4l2 = { device = "/dev/video0" }
)";

TEST(CameraEdit, SetsTheDeviceOfOneCameraAndKeepsTheRest) {
  std::string expected = kTwoCameras;
  expected.replace(expected.find("SN-1"), 4, "SN \\\"2\\\"");
  const auto changed = with_camera_address(kTwoCameras, "a", "genicam", "camera", "SN \"2\"");
  ASSERT_TRUE(changed) << changed.error().message;
  EXPECT_EQ(*changed, expected);
}

TEST(CameraEdit, RefusesACameraWithoutSuchATable) {
  for (const auto& [name, back_end] : std::vector<std::pair<std::string, std::string>>{
           {"none", "genicam"}, {"a", "v4l2"}, {"b", "v4l2"}}) {
    const auto changed = with_camera_address(kTwoCameras, name, back_end, "device", "x");
    ASSERT_FALSE(changed) << name;
    EXPECT_THAT(changed.error().message, HasSubstr("camera " + name + " has no table"));
  }
  EXPECT_FALSE(with_camera_address("not TOML", "a", "genicam", "camera", "x"));
}

}  // namespace
}  // namespace orbwatch::app::files
