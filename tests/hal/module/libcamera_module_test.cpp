// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hal/module/load_module.h"

namespace orbwatch::hal {
namespace {

/// Module from the build folder.
TEST(LibcameraModule, LoadsIntoAProgramWithoutLibcamera) {
  const auto module = load_module(
      std::filesystem::path(ORBWATCH_BUILT_MODULES) / "camera-libcamera.so", "libcamera");
  ASSERT_TRUE(module) << module.error().message;
  EXPECT_THAT((*module)->library_version(), testing::ContainsRegex("[0-9]+\\.[0-9]+"));
  for (const CameraEntry& camera : (*module)->list_cameras()) {
    EXPECT_EQ(camera.back_end, "libcamera");
  }
}

}  // namespace
}  // namespace orbwatch::hal
