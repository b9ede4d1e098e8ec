// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "proc/align/register/gradients/gradient_field.h"
#include "proc/align/register/place_change.h"

namespace orbwatch::align {

/// A camera's rotation and outline on which edges agree best.
struct PlaceFit {
  Place place;
  PlaceCovariance covariance;
};

/// Least squares of the edges' offsets over turn and outline together, from a rotation that is
/// right to the smoothing. The outline has a prior: the sought camera's, to kOutlinePrior. Edges of
/// one part of the sphere deviate together; the covariance follows from how far the parts
/// contradict each other. `samples` of the reference camera's field, `field` of the sought camera
/// at `start`; `smoothing` of both, degrees. Reentrant. Error: edges that do not determine the
/// rotation, or a place that makes no projection.
Result<PlaceFit> fit_place(const std::vector<GradientField::Sample>& samples,
                           const GradientField& field, const SoughtCamera& sought,
                           const Place& start, double smoothing);

/// Standard deviation of a given outline's centre and radius, px: that of a detected one.
inline constexpr double kOutlinePrior = 0.5;

}  // namespace orbwatch::align
