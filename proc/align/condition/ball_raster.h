// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>

#include "proc/align/condition/ball_crop.h"

namespace orbwatch::align {

/// Side of a square of ball coordinates: the limb is a circle in it, independent of its place and
/// size in the picture, so that a mark on the ball stays in its pixel.
inline constexpr int kRasterSide = 256;
inline constexpr double kRasterRadius = 120;  ///< the limb's, px of the raster

/// Distance of a raster pixel from the middle, 1 at the limb.
double raster_rho(int u, int v);

/// The ball's picture in the raster.
struct BallRaster {
  cv::Mat brightness;     ///< float, counts; outside of the picture 0
  double full_scale = 0;  ///< counts
  double noise = 0;       ///< upper bound of a pixel's standard deviation, counts
};

/// Warps the ball onto the raster. Reentrant.
BallRaster raster_of(BallCrop crop);

}  // namespace orbwatch::align
