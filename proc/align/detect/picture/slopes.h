// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

namespace orbwatch::align {

/// The slopes of a picture's brightness, blurred by about a pixel; float, brightness per pixel.
struct Slopes {
  cv::Mat along_u;
  cv::Mat along_v;
  float floor2 = 0;  ///< the squared noise threshold of slopes

  int width() const { return along_u.cols; }
  int height() const { return along_u.rows; }
};

/// `luminance`: one channel, 8 or 16 bit. Reentrant.
Slopes slopes_of(const cv::Mat& luminance);

}  // namespace orbwatch::align
