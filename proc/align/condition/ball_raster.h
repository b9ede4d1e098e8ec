#pragma once

#include <opencv2/core.hpp>

#include "proc/align/condition/ball_crop.h"

namespace orbwatch::align {

/// A square of ball coordinates: the limb is a circle in it, wherever and however large it is in
/// the picture, so that what stays on the ball stays in its pixel.
inline constexpr int kRasterSide = 256;
inline constexpr double kRasterRadius = 120;  ///< of the limb, px of the raster

/// The distance of a raster's pixel from its middle, 1 at the limb.
double raster_rho(int u, int v);

/// The ball's picture in the raster.
struct BallRaster {
  cv::Mat brightness;     ///< float, counts; outside of the picture 0
  double full_scale = 0;  ///< counts
  double noise = 0;       ///< at most, of a pixel, counts
};

/// Reentrant.
BallRaster raster_of(BallCrop crop);

}  // namespace orbwatch::align
