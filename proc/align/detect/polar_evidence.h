#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "proc/align/detect/reflection_law.h"
#include "proc/align/detect/slopes.h"
#include "proc/optics/vec.h"

namespace orbwatch::align {

/// What slopes say of circular limbs around one point: inside they should follow the ReflectionLaw,
/// outside not, and an edge should stand on the limb. Pixels.
class PolarEvidence {
 public:
  /// For limbs between `nearest` and `farthest`.
  PolarEvidence(const Slopes& slopes, const ReflectionLaw& law, optics::Vec2 centre, double nearest,
                double farthest);

  /// The logarithm of the likelihoods' ratio for a ball with a limb of that radius, all slopes
  /// together; what the picture does not show says nothing.
  double operator()(double radius) const;

 private:
  static constexpr std::size_t kSectors = 32;
  static constexpr std::size_t kAnglesPerSector = 2;
  static constexpr std::size_t kAngles = kSectors * kAnglesPerSector;

  /// Of one radius, or summed up from the innermost one on.
  struct Sums {
    std::array<float, ReflectionLaw::kRings> rings{};
    float area = 0;
    void operator+=(const Sums& other);
  };
  struct Direction {
    float cos, sin;
  };
  static std::array<Direction, kAngles> directions();

  void sum_up(const Slopes& slopes, const ReflectionLaw& law, optics::Vec2 centre,
              std::size_t angle, std::vector<float>& edges);
  void add_edges(const std::vector<float>& edges, std::size_t sector, float floor2);
  double of(std::size_t sector, double radius) const;
  double ring(std::size_t sector, std::size_t n, double from, double to) const;
  double area(std::size_t sector, double from, double to) const;

  /// The two stored radii around one, and the share of the second.
  struct Place {
    std::size_t index;
    double share;
  };
  Place place(double radius) const;

  int first_;                    ///< stored radius
  std::size_t count_;            ///< of stored radii, 1 px apart
  std::vector<Sums> sums_;       ///< by sector and radius
  std::vector<float> contours_;  ///< the same
};

}  // namespace orbwatch::align
