// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "proc/image/result.h"
#include "proc/optics/vec.h"
#include "proc/optics/view_projection.h"

namespace orbwatch::signals {

/// A spherical polygon, represented as a plane one in the gnomonic projection around its middle,
/// where great circles are straight lines. Immutable; reentrant.
class SphericalPolygon {
 public:
  /// `outline`: vectors of any length to its corners, in either sense of rotation. Error: fewer
  /// than three, one without a direction, or it does not fit into half of the sphere.
  static Result<SphericalPolygon> make(std::span<const optics::Vec3> outline);

  /// `direction`: unit vector.
  bool contains(const optics::Vec3& direction) const;

  /// The polygon's edges in a view, as lines of pixels of which the view shows at least one end of
  /// each piece: an edge that leaves the view ends slightly outside of it.
  std::vector<std::vector<optics::Vec2>> lines_in(const optics::ViewProjection& view) const;

 private:
  explicit SphericalPolygon(const optics::Vec3& sum);

  std::optional<optics::Vec2> project(const optics::Vec3& direction) const;
  optics::Vec3 direction_of(const optics::Vec2& place) const;

  optics::Vec3 middle_, right_, up_;
  std::vector<optics::Vec2> corners_;
};

}  // namespace orbwatch::signals
