// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/picture_size.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace orbwatch::app {
namespace {

hal::DecodedPicture picture(int width, int height) {
  hal::DecodedPicture decoded;
  decoded.picture.width = width;
  decoded.picture.height = height;
  return decoded;
}

optics::RigCamera rig_camera() {
  optics::RigCamera camera;
  camera.name = "A";
  camera.width = 640;
  camera.height = 480;
  return camera;
}

TEST(PictureSize, IsTheRigs) { EXPECT_TRUE(check_picture_size(picture(640, 480), rig_camera())); }

TEST(PictureSize, IsRefusedWithBothSizes) {
  for (const auto& [width, height] : {std::pair(640, 481), std::pair(639, 480)}) {
    const auto fits = check_picture_size(picture(width, height), rig_camera());
    ASSERT_FALSE(fits);
    EXPECT_EQ(fits.error().message, "the picture is " + std::to_string(width) + "x" +
                                        std::to_string(height) +
                                        " px, but camera A of the rig has 640x480 px");
  }
}

TEST(PictureSize, IsRefusedWithTheOrientationThatTurnsThePicture) {
  hal::DecodedPicture turned = picture(480, 640);
  turned.is_turned = true;
  const auto fits = check_picture_size(turned, rig_camera());
  ASSERT_FALSE(fits);
  EXPECT_EQ(fits.error().message,
            "the picture is 480x640 px, but camera A of the rig has 640x480 px; its EXIF "
            "orientation turns its 640x480");
}

}  // namespace
}  // namespace orbwatch::app
