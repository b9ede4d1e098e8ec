// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "app/simulation/machine.h"

namespace orbwatch::app::simulation {

/// Processing head at one moment: a solid of revolution about the vertical through its tip. Machine
/// frame, mm. Reentrant.
class Nozzle {
 public:
  /// `ceiling`: height at which the column ends.
  Nozzle(const NozzleSettings& settings, const Vec3& tip, double ceiling);

  /// Distance at which a ray from outside first hits it, or kNever.
  double entry(const Ray& ray) const;

  /// Outward unit normal at a point of its surface.
  Vec3 normal_at(const Vec3& point) const;

  bool is_cone(const Vec3& point) const { return point.z < cone_top_; }

  /// Spheres whose union contains the nozzle.
  std::span<const Sphere> bounds() const { return {bounds_.data(), bound_count_}; }

 private:
  Vec3 tip_;
  double tip_radius_;
  double slope_;        ///< radius per height of the cone
  double cone_cosine_;  ///< cosine of the angle between the cone's normal and the horizontal
  double cone_top_;
  double column_radius_;
  double ceiling_;
  std::size_t bound_count_ = 0;
  std::array<Sphere, 32> bounds_;
};

}  // namespace orbwatch::app::simulation
