// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "proc/image/picture.h"
#include "proc/remap/grid/source_area.h"
#include "proc/remap/sampling/sharpening.h"

namespace orbwatch::remap {

/// True if pictures of a format are sharpened: 8 bit colour. One-channel and 16 bit pictures are
/// measured.
constexpr bool can_sharpen(PixelFormat format) {
  return info(format).colour != ColourModel::Luminance && info(format).bytes_per_sample() == 1;
}

/// A picture prepared for display: for YUV the luminance sharpened, for RGB every channel. Planes
/// of chroma are the source's own. Thread-compatible: areas that share no row may be filled at the
/// same time.
class SharpenedPicture {
 public:
  /// Allocates memory for pictures of that format and size. Preconditions: can_sharpen(format);
  /// `sharpness` in 0..kMaxSharpness.
  SharpenedPicture(PixelFormat format, int width, int height, double sharpness);

  /// Sets the picture to sharpen; it must outlive its use.
  void set_source(const Picture& source);

  /// Fills the pixels of an area within the picture; where two pixels of a row share chroma, both
  /// or none of them.
  void fill(const SourceArea& area);

  /// The sharpened picture; undefined where it was not filled since set_source().
  const Picture& picture() const { return picture_; }

 private:
  SharpeningGains gains_;
  std::vector<std::byte> memory_;  ///< memory of the first plane
  Picture source_;
  Picture picture_;
};

}  // namespace orbwatch::remap
