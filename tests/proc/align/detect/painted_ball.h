// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <opencv2/imgproc.hpp>
#include <random>

#include "proc/optics/outline.h"

namespace orbwatch::align {

/// The limbs of the balls that tests paint, with the picture's size: one ball and a smaller one.
inline const optics::Outline kPaintedLimb{{202.3, 161.7}, 115, 115, 0};
inline const cv::Size kPaintedSize(400, 320);
inline const optics::Outline kSmallLimb{{132.3, 101.7}, 80, 80, 0};
inline const cv::Size kSmallSize(264, 204);

/// A far-away camera's picture of a ball in a room of random spots, by the law of reflection, with
/// the same spots behind the ball: 8 bit grey, 4x4 samples to a pixel.
inline cv::Mat painted_ball(const cv::Size& size, const optics::Outline& limb) {
  std::mt19937 random(7);
  cv::Mat spots(256, 512, CV_8U, cv::Scalar(90));
  const auto below = [&](unsigned end) { return static_cast<int>(random() % end); };
  for (int i = 0; i < 600; ++i) {
    // Separate statements: the compiler chooses the order of arguments.
    const int y = below(256), x = below(512), grey = below(256), radius = 2 + below(7);
    cv::circle(spots, {x, y}, radius, cv::Scalar(grey), cv::FILLED);
  }
  const auto light = [&](double u, double v) -> double {
    const double x = (u - limb.centre.u) / limb.rx, y = (v - limb.centre.v) / limb.ry;
    const double rho2 = x * x + y * y;
    if (rho2 >= 1) {
      return spots.at<std::uint8_t>((static_cast<int>(v / 2) & 255),
                                    (static_cast<int>(u / 2) & 511));
    }
    // The reflected direction as longitude and latitude.
    const double z = std::sqrt(1 - rho2);
    const double longitude = std::atan2(2 * x * z, 2 * z * z - 1);
    const double latitude = std::asin(std::clamp(2 * y * z, -1.0, 1.0));
    return spots.at<std::uint8_t>((static_cast<int>((latitude + 1.6) * 80) & 255),
                                  (static_cast<int>((longitude + 3.2) * 80) & 511));
  };
  cv::Mat picture(size, CV_8U);
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      double sum = 0;
      for (int i = 0; i < 16; ++i) sum += light(u + (i % 4 - 1.5) / 4, v + (i / 4 - 1.5) / 4);
      picture.at<std::uint8_t>(v, u) = cv::saturate_cast<std::uint8_t>(sum / 16);
    }
  }
  return picture;
}

}  // namespace orbwatch::align
