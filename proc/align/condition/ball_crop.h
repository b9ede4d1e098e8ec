// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// The part of a picture that shows the ball.
struct BallCrop {
  cv::Mat brightness;       ///< float, counts
  optics::Outline outline;  ///< in the crop's pixels
  double full_scale = 0;    ///< counts
  double noise = 0;         ///< standard deviation of a pixel, counts

  /// Distance of a pixel from the middle of the ball, 1 at the limb.
  double rho(double u, double v) const;
};

/// Crops a picture of any format, and halves its sides so many times, each by the means of 2 x 2
/// pixels in the picture's own depth. `outline` must have been checked for the picture. Reentrant.
/// Error: the picture shows less than half of the ball's bounding box, or the light does not allow
/// the ball to be judged: dark, or overexposed.
Result<BallCrop> crop_ball(const Picture& picture, const optics::Outline& outline,
                           int halvings = 0);

/// The same crop at half the size: means of 2 x 2 pixels. Reentrant.
BallCrop halved(const BallCrop& crop);

}  // namespace orbwatch::align
