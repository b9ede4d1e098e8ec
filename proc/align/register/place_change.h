// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <opencv2/core.hpp>
#include <optional>
#include <vector>

#include "proc/align/register/registration.h"

namespace orbwatch::align {

/// Unknowns of a camera that is turned about the ball: a small turn about the reference frame's
/// axes, radians, then twice the changes of the outline's centre and radius as shares of the
/// radius: radians in the middle of the ball's picture.
inline constexpr int kPlaceUnknowns = 6;
using PlaceChange = cv::Vec<double, kPlaceUnknowns>;
using PlaceCovariance = cv::Matx<double, kPlaceUnknowns, kPlaceUnknowns>;

/// A camera's registration and outline.
struct Place {
  optics::Mat3 rotation;
  optics::Outline outline;
};

/// Reentrant.
Place changed(const Place& place, const PlaceChange& by);

/// The change of the outline alone that leads from one to another. Reentrant.
PlaceChange outline_change(const optics::Outline& from, const optics::Outline& to);

/// The outline with its centre and radius changed by shares of the radius. Reentrant.
optics::Outline changed(const optics::Outline& outline, double u, double v, double radius);

/// Shifts of what a camera shows, over the sphere, by changes of its place. Reentrant, immutable.
class PlaceShifts {
 public:
  /// Error: a place that makes no projection.
  static Result<PlaceShifts> make(const SoughtCamera& sought, const Place& place);

  /// A camera with the unknown changed by a little shows in `direction` what the unchanged one
  /// shows at direction + change * shift. nullopt in the blind cone and next to it.
  using Shifts = std::array<optics::Vec3, kPlaceUnknowns>;
  std::optional<Shifts> at(const optics::Vec3& direction) const;

  /// The camera at the place.
  const optics::BallProjection& ball() const { return balls_.front(); }

 private:
  explicit PlaceShifts(std::vector<optics::BallProjection> balls) : balls_(std::move(balls)) {}

  /// At the place, then to either side of each unknown.
  std::vector<optics::BallProjection> balls_;
};

}  // namespace orbwatch::align
