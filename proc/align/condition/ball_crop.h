#pragma once

#include <opencv2/core.hpp>

#include "proc/image/picture.h"
#include "proc/image/result.h"
#include "proc/optics/outline.h"

namespace orbwatch::align {

/// The part of a picture that shows the ball.
struct BallCrop {
  cv::Mat brightness;       ///< float, counts
  optics::Outline outline;  ///< in its pixels
  double full_scale = 0;    ///< counts
  double noise = 0;         ///< standard deviation of a pixel, counts

  /// Where a pixel lies on the ball: distance from the middle, 1 at the limb.
  double rho(double u, double v) const;
};

/// Of a picture of any format. `outline`: checked for it. Reentrant. Error: the picture shows less
/// than half of the ball's bounding box, or it is not lit as it must be to judge what it shows:
/// dark, or overexposed.
Result<BallCrop> crop_ball(const Picture& picture, const optics::Outline& outline);

/// The same in half the size: means of 2 x 2 pixels. Reentrant.
BallCrop halved(const BallCrop& crop);

}  // namespace orbwatch::align
