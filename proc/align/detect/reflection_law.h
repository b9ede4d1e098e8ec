#pragma once

#include <array>
#include <cstddef>

namespace orbwatch::align {

/// How much more likely a slope of brightness is on a mirror ball than anywhere else, by its
/// direction alone.
///
/// A ball shows a room compressed: at the share rho of the limb's radius by k = 1 / (1 - rho^2)
/// more along the radius than across it (phi = 2 asin rho, seen from far away). Where slopes of the
/// room have any direction, those of its image make the angle a with the radius with the density
/// k / (cos^2 a + k^2 sin^2 a) / pi. The law counts in rings; what is within the first one tells
/// nothing. Immutable; reentrant.
class ReflectionLaw {
 public:
  static constexpr std::size_t kRings = 5;
  /// Inner radii, shares of the limb's; the last ring ends at the limb.
  static constexpr std::array<double, kRings + 1> kBounds{0.5, 0.7, 0.8, 0.88, 0.94, 1};

  ReflectionLaw();

  /// The logarithms of the likelihoods' ratio, by ring. `share`: cos^2 a, in [0, 1].
  const std::array<float, kRings>& at(float share) const {
    return table_[static_cast<std::size_t>(share * (kSteps - 0.01F))];
  }

 private:
  static constexpr std::size_t kSteps = 64;
  std::array<std::array<float, kRings>, kSteps> table_;
};

}  // namespace orbwatch::align
