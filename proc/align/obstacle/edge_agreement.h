#pragma once

#include <cstddef>
#include <vector>

#include "proc/align/register/registration.h"
#include "proc/image/result.h"
#include "proc/optics/vec.h"

namespace orbwatch::align {

/// How well two cameras' edges agree below the ball, direction by direction, for every distance
/// that what stands there might have. Closeness: ball radius / distance from the ball's centre.
class EdgeAgreement {
 public:
  /// A direction that both cameras show, whatever the closeness.
  struct Place {
    optics::Vec3 direction;
    double stated = 0;     ///< closeness by the scene of the projections
    std::size_t cell = 0;  ///< of the sphere, below kCells
  };

  static constexpr double kClosest = 0.45;    ///< what is nearer to the ball is not looked at
  static constexpr std::size_t kCells = 800;  ///< some 7 degrees wide

  /// Both cameras are registered, in one reference frame, whose Z points up. `scene`: that of both
  /// projections. Takes some seconds. Reentrant. Error: none of these directions is shown by both.
  static Result<EdgeAgreement> measure(const ReferenceCamera& first, const ReferenceCamera& second,
                                       const optics::Scene& scene);

  const std::vector<Place>& places() const { return places_; }

  /// The squared product of both gradients, less what it is by chance, where they have nothing to
  /// do with each other; about -1/2 to 1/2. `place`: of places().
  double above_chance(std::size_t place, double closeness) const;

 private:
  std::vector<Place> places_;
  double farthest_ = 0;  ///< closeness of the first level
  std::size_t levels_ = 0;
  std::vector<float> values_;  ///< levels_ of each place
};

}  // namespace orbwatch::align
