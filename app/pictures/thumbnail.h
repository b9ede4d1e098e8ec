// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "proc/image/picture.h"

namespace orbwatch::app {

/// A small picture of a large one. Thread-bound; reuses its memory.
class Thumbnail {
 public:
  /// Limit in pixels.
  static constexpr int kLongestSide = 160;

  /// Scales a picture to Rgb, or Grey for luminance, each pixel the mean of the pixels that it
  /// covers, neither side above kLongestSide; valid until the next call. A picture that is small
  /// enough keeps its size. `picture` must not be empty.
  Picture of(const Picture& picture);

 private:
  std::vector<std::byte> converted_, small_;
};

}  // namespace orbwatch::app
