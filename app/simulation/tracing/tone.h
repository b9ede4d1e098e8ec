// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "app/simulation/tracing/ray.h"

namespace orbwatch::app::simulation {

/// Linear light as measured by the simulated colour cameras: x red, y green, z blue; 1 is full
/// scale.
using Light = Vec3;

/// One pixel, sRGB.
using Rgb8 = std::array<std::uint8_t, 3>;

/// Converts linear light to a colour camera's samples by tables. Immutable; reentrant.
class Tone {
 public:
  Tone();

  /// Encodes to sRGB (IEC 61966-2-1), saturating.
  Rgb8 encode(const Light& light) const {
    return {encode(light.x), encode(light.y), encode(light.z)};
  }
  Light decode(const std::uint8_t* rgb) const {
    return {linear_[rgb[0]], linear_[rgb[1]], linear_[rgb[2]]};
  }

  /// Glow of a body at `celsius`: Wien's approximation of Planck's law for 610, 550 and 465 nm,
  /// exposed so that red reaches full scale at 1200 degC. No glow below 500 degC.
  const Light& incandescence(double celsius) const;

 private:
  std::uint8_t encode(double linear) const;

  std::vector<std::uint8_t> encoded_;  ///< index: linear light from 0 to 1
  std::array<double, 256> linear_;     ///< index: encoded value
  std::vector<Light> glow_;            ///< index: degC
};

}  // namespace orbwatch::app::simulation
