// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/radiometry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace orbwatch::signals {
namespace {

constexpr double kZero = 273.15;

double planck(double um, double celsius) {
  return 1 / (std::exp(14387.77 / (um * (celsius + kZero))) - 1);
}

/// The counts of a camera, by searching for the temperature of the black body with the same
/// radiance.
double counts_by_bisection(const RadiometrySettings& s, double celsius) {
  const double rho = *s.reflectivity, eps = *s.emissivity, um = s.wavelength;
  const double scene = eps * planck(um, celsius) + (1 - eps) * planck(um, s.surroundings);
  const double seen = rho * scene + (1 - rho) * planck(um, s.ball_temperature);
  double low = -kZero + 1, high = 10000;
  for (int i = 0; i < 200; ++i) {
    const double middle = (low + high) / 2;
    (planck(um, middle) < seen ? low : high) = middle;
  }
  return (low + kZero - s.kelvin_offset) / s.kelvin_per_count;
}

TEST(Radiometry, WithoutCalibrationIsTheCamerasScaleExactly) {
  const auto scale = Radiometry::make({.kelvin_per_count = 0.04}).value();
  EXPECT_TRUE(scale.is_radiometric());
  EXPECT_TRUE(scale.is_apparent());
  for (const double counts : {0.0, 1.0, 7327.5, 41828.75, 65535.0}) {
    EXPECT_NEAR(scale.celsius(counts), counts * 0.04 - kZero, 1e-4);
  }
  EXPECT_DOUBLE_EQ(scale.counts(1400), (1400 + kZero) / 0.04);
}

TEST(Radiometry, CountsMayBeginAtAnyTemperature) {
  const auto tenths_of_celsius =
      Radiometry::make({.kelvin_per_count = 0.1, .kelvin_offset = kZero}).value();
  EXPECT_NEAR(tenths_of_celsius.celsius(0), 0, 1e-4);
  EXPECT_NEAR(tenths_of_celsius.celsius(12345), 1234.5, 1e-3);
  EXPECT_DOUBLE_EQ(tenths_of_celsius.counts(1234.5), 12345);
  EXPECT_LT(tenths_of_celsius.counts(-20), 0);
  const auto refused = [](double offset) {
    return !Radiometry::make({.kelvin_per_count = 0.1, .kelvin_offset = offset});
  };
  EXPECT_TRUE(refused(1001));
  EXPECT_TRUE(refused(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_FALSE(refused(-100));
}

TEST(Radiometry, UndoesBallAndEmissivityOfCountsWithAnOffset) {
  const RadiometrySettings settings{.kelvin_per_count = 0.04,
                                    .wavelength = 3.9,
                                    .emissivity = 0.8,
                                    .surroundings = 35,
                                    .reflectivity = 0.9,
                                    .ball_temperature = 60,
                                    .kelvin_offset = 173.15};
  const auto scale = Radiometry::make(settings).value();
  for (const double celsius : {600.0, 1400.0, 2100.0}) {
    const double counts = counts_by_bisection(settings, celsius);
    EXPECT_NEAR(scale.counts(celsius), counts, 1e-3 * counts);
    EXPECT_NEAR(scale.celsius(counts), celsius, 0.2);
  }
}

TEST(Radiometry, UndoesBallAndEmissivity) {
  for (const double um : {0.9, 3.9, 10.0}) {
    for (const double rho : {0.5, 0.9, 1.0}) {
      for (const double eps : {0.25, 0.8, 1.0}) {
        const RadiometrySettings settings{.kelvin_per_count = 0.04,
                                          .wavelength = um,
                                          .emissivity = eps,
                                          .surroundings = 35,
                                          .reflectivity = rho,
                                          .ball_temperature = 60};
        const auto scale = Radiometry::make(settings).value();
        EXPECT_FALSE(scale.is_apparent());
        for (const double celsius : {600.0, 1400.0, 2100.0}) {
          const double counts = counts_by_bisection(settings, celsius);
          EXPECT_NEAR(scale.counts(celsius), counts, 1e-3 * counts);
          EXPECT_NEAR(scale.celsius(counts), celsius, 0.2) << um << " um " << rho << " " << eps;
        }
      }
    }
  }
}

TEST(Radiometry, LessLightThanTheBallsOwnHasNoTemperature) {
  const auto scale =
      Radiometry::make({.kelvin_per_count = 0.04, .reflectivity = 0.5, .ball_temperature = 200})
          .value();
  EXPECT_TRUE(std::isnan(scale.celsius(100)));
  EXPECT_FALSE(std::isnan(scale.celsius(40000)));
}

TEST(Radiometry, ACameraThatIsNotRadiometricHasNoScale) {
  EXPECT_FALSE(Radiometry::make({}).value().is_radiometric());
}

TEST(Radiometry, RefusesWhatCannotBe) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const RadiometrySettings good{.kelvin_per_count = 0.04};
  const auto refused = [&](auto change) {
    RadiometrySettings settings = good;
    change(settings);
    return !Radiometry::make(settings);
  };
  for (const double bad : {-1.0, nan, HUGE_VAL}) {
    EXPECT_TRUE(refused([&](auto& s) { s.kelvin_per_count = bad; })) << bad;
    EXPECT_TRUE(refused([&](auto& s) { s.wavelength = bad; })) << bad;
    EXPECT_TRUE(refused([&](auto& s) { s.emissivity = bad; })) << bad;
    EXPECT_TRUE(refused([&](auto& s) { s.reflectivity = bad; })) << bad;
  }
  EXPECT_TRUE(refused([](auto& s) { s.emissivity = 0; }));
  EXPECT_TRUE(refused([](auto& s) { s.reflectivity = 1.01; }));
  EXPECT_TRUE(refused([](auto& s) { s.surroundings = -300; }));
  EXPECT_TRUE(refused([&](auto& s) { s.ball_temperature = nan; }));
}

}  // namespace
}  // namespace orbwatch::signals
