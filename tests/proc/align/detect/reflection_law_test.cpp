#include "proc/align/detect/reflection_law.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "proc/optics/vec.h"

namespace orbwatch::align {
namespace {

/// cos^2 of the angle between the radius and the slope that a far room's slope of direction
/// `angle` has on a ball seen from far away, at the share rho of its radius: by differences of the
/// reflected ray, with plain vectors.
double reflected_share(double rho, double angle) {
  using optics::Vec3;
  const auto reflected = [](double x, double y) {
    const Vec3 normal{x, y, std::sqrt(1 - x * x - y * y)}, sight{0, 0, -1};
    return sight - normal * (2 * dot(sight, normal));
  };
  constexpr double kStep = 1e-6;
  // Displacements of the direction in the room per displacement in the picture, along the radius
  // and across it, as lengths on the sphere of directions.
  const Vec3 here = reflected(rho, 0);
  const double along = norm(reflected(rho + kStep, 0) - here) / kStep;
  const double across = norm(reflected(rho, kStep) - here) / kStep;
  const double x = std::cos(angle) * along, y = std::sin(angle) * across;
  return x * x / (x * x + y * y);
}

TEST(ReflectionLaw, IsTheLikelihoodOfReflectedSlopes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any_angle(0, 2 * std::numbers::pi);
  const ReflectionLaw law;
  for (std::size_t ring = 0; ring + 2 < ReflectionLaw::kRings; ++ring) {
    const double rho = (ReflectionLaw::kBounds[ring] + ReflectionLaw::kBounds[ring + 1]) / 2;
    double right = 0, wrong = 0;
    constexpr int kSlopes = 20'000;
    for (int i = 0; i < kSlopes; ++i) {
      const double angle = any_angle(random);
      right += law.at(static_cast<float>(reflected_share(rho, angle)))[ring] / kSlopes;
      wrong += law.at(static_cast<float>(std::pow(std::cos(angle), 2)))[ring] / kSlopes;
    }
    // Gibbs' inequality: a likelihood is right about what it describes, and wrong about the rest.
    EXPECT_GT(right, 0) << ring;
    EXPECT_LT(wrong, 0) << ring;
  }
}

TEST(ReflectionLaw, AsksForMoreTowardsTheLimb) {
  const ReflectionLaw law;
  for (std::size_t ring = 1; ring < ReflectionLaw::kRings; ++ring) {
    EXPECT_GT(law.at(1.0F)[ring], law.at(1.0F)[ring - 1]);
    EXPECT_LT(law.at(0.5F)[ring], law.at(0.5F)[ring - 1]);
  }
}

}  // namespace
}  // namespace orbwatch::align
