// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <vector>

#include "proc/align/register/registration.h"
#include "proc/image/result.h"
#include "proc/optics/vec.h"

namespace orbwatch::align {

/// Agreement of two cameras' edges below the ball, direction by direction, for every distance that
/// the object there might have. Closeness: ball radius / distance from the ball's centre.
class EdgeAgreement {
 public:
  /// A direction that both cameras show at every closeness.
  struct Place {
    optics::Vec3 direction;
    double stated = 0;     ///< closeness in the scene of the projections
    std::size_t cell = 0;  ///< cell of the sphere, below kCells
  };

  static constexpr double kClosest = 0.45;    ///< greatest closeness evaluated
  static constexpr std::size_t kCells = 800;  ///< some 7 degrees wide

  /// Both cameras are registered, in one reference frame, whose Z points up. `scene`: that of both
  /// projections. Takes some seconds. Reentrant. Error: none of these directions is shown by both.
  static Result<EdgeAgreement> measure(const ReferenceCamera& first, const ReferenceCamera& second,
                                       const optics::Scene& scene);

  const std::vector<Place>& places() const { return places_; }

  /// The squared product of both gradients, less its expectation for unrelated gradients; about
  /// -1/2 to 1/2. `place`: index into places().
  double above_chance(std::size_t place, double closeness) const;

 private:
  std::vector<Place> places_;
  double farthest_ = 0;  ///< closeness of the first level
  std::size_t levels_ = 0;
  std::vector<float> values_;  ///< levels_ values for each place
};

}  // namespace orbwatch::align
