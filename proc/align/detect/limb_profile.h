#pragma once

#include <array>
#include <cstddef>

#include "proc/align/detect/limb_strip.h"

namespace orbwatch::align {

/// How much more likely a slope is at a distance from the limb than anywhere around it, by its
/// kind.
///
/// At the limb a ball reflects what is behind it: there is hardly a step of brightness. But inward
/// the reflection passes with the root of the distance, so that slopes along the normal are strong
/// up to the limb, strongest on it, and weak within the blur outside of it. How they fade there was
/// counted in simulated rooms: tests/proc/align/detect/learn_limb_profile.cpp writes the table.
namespace limb_profile {

/// Distances are columns of a LimbStrip, from kFarthest inside to kFarthest outside.
constexpr int kFarthest = 12;
constexpr std::size_t kColumns = 2 * kFarthest + 1;
/// Kinds of slopes: their share along the normal, and their energy in powers of 4 of floor2.
constexpr std::size_t kShares = 4, kEnergies = 6, kKinds = kShares * kEnergies;

inline std::size_t kind(const LimbStrip::Slope& slope, float floor2) {
  std::size_t energy = 0;
  for (float limit = floor2; energy + 1 < kEnergies && slope.energy() >= limit; limit *= 4) {
    ++energy;
  }
  constexpr float kBelowOne = 0.999F;
  const auto share = static_cast<std::size_t>(slope.share() * kBelowOne * kShares);
  return share * kEnergies + energy;
}

/// Logarithms of the likelihoods' ratio, nats, by distance; the innermost first.
const std::array<float, kColumns>& at(std::size_t kind);

}  // namespace limb_profile
}  // namespace orbwatch::align
