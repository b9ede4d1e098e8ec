// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "proc/align/drift/brightness_reader.h"
#include "proc/align/drift/patch.h"
#include "proc/image/picture.h"

namespace orbwatch::align {

/// A picture's brightness at a scale, 32F: the mean over squares of `scale` pixels (of four of them
/// in squares above 2), slightly smoothed. `scale`: 1 or even. Reentrant.
cv::Mat smoothed_luminance(const Picture& picture, int scale);

/// Half the size of a smoothed picture, smoothed again. Reentrant.
cv::Mat halved(const cv::Mat& smoothed);

/// The brightness from which on a pixel of that format is saturated.
float saturation(PixelFormat format);

/// Reads the same brightness at a few places of a picture only. Not reentrant: it keeps its
/// buffers.
class WindowReader {
 public:
  explicit WindowReader(int scale) : scale_(scale), reader_(scale) {}

  /// Reads the window whose first pixel is `corner` at the scale; false when it is not within the
  /// picture.
  bool read(const Picture& picture, cv::Point corner, PatchWindow& window);

 private:
  int scale_;
  BrightnessReader reader_;
  BrightnessReader::Square samples_{};
};

/// Reads a window of a picture that is smoothed as a whole; false when it is not within.
bool read_window(const cv::Mat& smoothed, cv::Point corner, float saturated, PatchWindow& window);

}  // namespace orbwatch::align
