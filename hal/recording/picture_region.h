// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>

#include "hal/recording/messages.h"
#include "proc/image/picture.h"
#include "proc/image/result.h"

namespace orbwatch::hal::recording {

/// Part of a picture, px.
struct PictureRegion {
  int x = 0, y = 0, width = 0, height = 0;

  bool operator==(const PictureRegion&) const = default;
};

/// A camera's whole picture, of which a recording has a region.
struct PicturePlace {
  int width = 0, height = 0;  ///< sides of the whole picture
  PictureRegion region;

  bool operator==(const PicturePlace&) const = default;
};

/// The smallest region around `region`, which is inside of the picture, whose chroma is its own:
/// with even edges where two columns or rows share it. Reentrant.
PictureRegion widened(const PictureRegion& region, PixelFormat format);

/// Pixels of the region, which is inside of the picture and widened(); nothing is copied.
/// Reentrant.
template <class Byte>
BasicPicture<Byte> part_of(const BasicPicture<Byte>& picture, const PictureRegion& region) {
  const PixelFormatInfo& facts = info(picture.format);
  BasicPicture<Byte> part = picture;
  part.width = region.width;
  part.height = region.height;
  for (std::size_t n = 0; n < facts.plane_count(); ++n) {
    const PlaneInfo& plane = facts.planes[n];
    part.planes[n].data += (region.y >> plane.shift_y) * part.planes[n].stride +
                           (region.x >> plane.shift_x) * plane.samples * facts.bytes_per_sample();
  }
  return part;
}

/// Message that states the place, without a calibration.
CameraInfo camera_info_of(const PicturePlace& place, Header header);

/// The place that a message of any origin states. Errors: sides of 0 or above kMaxSide; a region
/// outside of the picture; binning. Reentrant.
Result<PicturePlace> place_of(const CameraInfo& message);

/// Checks that a picture of any origin fits its place in a whole picture of the format `whole`.
/// Errors: another size than that of the region; another format; edges that split chroma.
/// Reentrant.
Result<> check_fit(PixelFormat format, int width, int height, const PicturePlace& place,
                   PixelFormat whole);

/// Copies the pixels between pictures of one size and format, of any alignment. Reentrant.
void copy_pixels(const Picture& from, const MutablePicture& to);

/// Makes all pixels black. Reentrant.
void blacken(const MutablePicture& picture);

}  // namespace orbwatch::hal::recording
