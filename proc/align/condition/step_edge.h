// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>

namespace orbwatch::align {

/// A straight step of brightness, blurred by a Gaussian.
struct StepEdge {
  double contrast = 0;     ///< difference between the two sides, above 0
  double sigma = 0;        ///< sigma of the blur, the pixel's aperture included, px
  double sigma_error = 0;  ///< standard error of sigma, px
};

/// Pixels around an edge's own that the fit reads.
inline constexpr int kEdgeReach = 6;

/// Fits the step edge through `pixel` of `brightness`, a float picture, whose brightness changes
/// along the angle `normal`, radians from u towards v; `noise` is a pixel's standard deviation.
/// Every pixel counts at its distance across the edge, as for the slanted edge of ISO 12233;
/// nothing is interpolated. nullopt: the picture's border is within kEdgeReach, or there is not a
/// step: a line, a ramp, a corner, a blur of less than 0.2 px or more than half the reach.
/// Reentrant.
std::optional<StepEdge> fit_step_edge(const cv::Mat& brightness, const cv::Point& pixel,
                                      double normal, double noise);

}  // namespace orbwatch::align
