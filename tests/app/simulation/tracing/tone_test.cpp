// SPDX-License-Identifier: Apache-2.0
#include "app/simulation/tracing/tone.h"

#include <gtest/gtest.h>

#include <cmath>

namespace orbwatch::app::simulation {
namespace {

TEST(Tone, EncodesAsSrgb) {
  const Tone tone;
  EXPECT_EQ(tone.encode({0, 0.5, 1}), (Rgb8{0, 188, 255}));
  EXPECT_EQ(tone.encode({0.2, 0.01, 0.001}), (Rgb8{124, 25, 3}));
  EXPECT_EQ(tone.encode({-1, 7, 1e9}), (Rgb8{0, 255, 255})) << "saturates";
}

TEST(Tone, DecodesWhatItEncoded) {
  const Tone tone;
  for (int i = 0; i < 256; ++i) {
    const auto level = static_cast<std::uint8_t>(i);
    const Rgb8 pixel{level, level, level};
    EXPECT_EQ(tone.encode(tone.decode(pixel.data())), pixel);
  }
}

double planck(double metres, double kelvin) {
  constexpr double kPlanck = 6.62607015e-34, kLight = 299792458, kBoltzmann = 1.380649e-23;
  return std::pow(metres, -5) / std::expm1(kPlanck * kLight / (metres * kBoltzmann * kelvin));
}

TEST(Tone, GlowsAsPlancksLawSays) {
  const Tone tone;
  const double full_scale = planck(610e-9, 1473.15);
  for (const double celsius : {800.0, 1200.0, 1500.0, 2000.0, 2150.0}) {
    const Light& glow = tone.incandescence(celsius);
    const double kelvin = celsius + 273.15;
    EXPECT_NEAR(glow.x / (planck(610e-9, kelvin) / full_scale), 1, 1e-3) << celsius;
    EXPECT_NEAR(glow.y / (planck(550e-9, kelvin) / full_scale), 1, 1e-3) << celsius;
    EXPECT_NEAR(glow.z / (planck(465e-9, kelvin) / full_scale), 1, 1e-3) << celsius;
  }
  EXPECT_NEAR(tone.incandescence(1200).x, 1, 1e-9);
}

TEST(Tone, IsDarkWhenColdAndEndsItsTableSafely) {
  const Tone tone;
  EXPECT_EQ(norm(tone.incandescence(20)), 0);
  EXPECT_EQ(norm(tone.incandescence(-300)), 0);
  EXPECT_EQ(tone.incandescence(99999).x, tone.incandescence(3000).x);
}

}  // namespace
}  // namespace orbwatch::app::simulation
