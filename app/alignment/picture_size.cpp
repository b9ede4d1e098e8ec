// SPDX-License-Identifier: Apache-2.0
#include "app/alignment/picture_size.h"

#include <string>

namespace orbwatch::app {
namespace {

std::string size_text(int width, int height) {
  return std::to_string(width) + "x" + std::to_string(height) + " px";
}

}  // namespace

Result<> check_picture_size(const hal::DecodedPicture& picture, const optics::RigCamera& camera) {
  const int width = picture.picture.width, height = picture.picture.height;
  if (width == camera.width && height == camera.height) return {};
  return fail("the picture is " + size_text(width, height) + ", but camera " + camera.name +
              " of the rig has " + size_text(camera.width, camera.height) + exif_note(picture));
}

}  // namespace orbwatch::app
