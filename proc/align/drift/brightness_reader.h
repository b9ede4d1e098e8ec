// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core.hpp>

#include "proc/image/picture.h"

namespace orbwatch::align {

/// Reads the brightness of small squares of a picture at a scale, for less than OpenCV's calls
/// would cost. Reentrant, immutable.
class BrightnessReader {
 public:
  static constexpr int kSide = 27;
  using Square = std::array<float, kSide * kSide>;

  /// Samples along a side of a square of `scale` pixels: more would cost time without more
  /// information.
  static constexpr int kDense = 2;

  /// `scale`: 1 or even.
  explicit BrightnessReader(int scale) : scale_(scale) {}

  /// Each value is the mean over a square of `scale` pixels (of four of them in squares above 2),
  /// row by row. `first`: the picture's first pixel of the square. False when it is not within the
  /// picture.
  bool read(const Picture& picture, cv::Point first, Square& square) const;

 private:
  int scale_;
};

}  // namespace orbwatch::align
