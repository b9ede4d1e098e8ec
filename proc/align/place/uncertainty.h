// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <opencv2/core.hpp>
#include <optional>

#include "proc/align/place/adjustment.h"

namespace orbwatch::align {

/// The covariance of all columns of the equations, 0 for known ones. nullopt when the equations do
/// not determine every unknown, within rounding.
std::optional<cv::Mat1d> covariance(const Equations& equations);

/// The covariance of a camera's pose, as PlacedCamera documents it, from that of all columns.
cv::Matx66d pose_covariance(const PlaceRequest& request, const PlaceState& state,
                            const cv::Mat1d& all, std::size_t camera);

/// Degrees: the rms error of the direction, far away, that a pixel of this camera shows, over all
/// directions within 150 degrees of the one towards the camera that the picture shows, to first
/// order. `all`: the covariance of all columns.
double view_sigma(const PlaceRequest& request, const PlaceState& state, const cv::Mat1d& all,
                  std::size_t camera);

}  // namespace orbwatch::align
