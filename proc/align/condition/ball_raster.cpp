// SPDX-License-Identifier: Apache-2.0
#include "proc/align/condition/ball_raster.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace orbwatch::align {
namespace {

constexpr double kMiddle = (kRasterSide - 1) / 2.0;

}  // namespace

double raster_rho(int u, int v) { return std::hypot(u - kMiddle, v - kMiddle) / kRasterRadius; }

BallRaster raster_of(BallCrop crop) {
  while (std::min(crop.outline.rx, crop.outline.ry) > 1.5 * kRasterRadius) crop = halved(crop);
  const optics::Outline& limb = crop.outline;
  const double turn = optics::radians(limb.angle), c = std::cos(turn), s = std::sin(turn);
  const double a = limb.rx / kRasterRadius, b = limb.ry / kRasterRadius;
  // The ellipse's axes are mapped onto the circle, then turned back, so that up stays up.
  const double uu = a * c * c + b * s * s, uv = (a - b) * c * s, vv = a * s * s + b * c * c;
  const cv::Matx23d to_picture(uu, uv, limb.centre.u - (uu + uv) * kMiddle,  //
                               uv, vv, limb.centre.v - (uv + vv) * kMiddle);
  BallRaster raster{{}, crop.full_scale, crop.noise};
  cv::warpAffine(crop.brightness, raster.brightness, to_picture, {kRasterSide, kRasterSide},
                 cv::INTER_LINEAR | cv::WARP_INVERSE_MAP, cv::BORDER_CONSTANT, cv::Scalar(0));
  return raster;
}

}  // namespace orbwatch::align
