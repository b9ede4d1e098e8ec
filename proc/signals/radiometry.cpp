// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/radiometry.h"

#include <cmath>
#include <limits>
#include <string>

#include "proc/image/celsius.h"

namespace orbwatch::signals {
namespace {

constexpr double kSecondRadiation = 14387.76877;  // um K, CODATA 2018
constexpr std::size_t kCounts = std::size_t{1} << 16;

/// Planck's law at one wavelength (um), as a share of its constant factor.
double radiance(double wavelength, double kelvin) {
  return 1 / std::expm1(kSecondRadiation / (wavelength * kelvin));
}

/// The inverse of radiance(), for a radiance above 0.
double temperature(double wavelength, double radiance) {
  return kSecondRadiation / (wavelength * std::log1p(1 / radiance));
}

Result<> check(const std::string& name, double value, double above, double up_to) {
  if (value > above && value <= up_to) return {};
  return fail("radiometry: " + name + " is " + std::to_string(value) + "; it must be above " +
              std::to_string(above) + " and at most " + std::to_string(up_to));
}

Result<> check(const RadiometrySettings& s) {
  constexpr double kHottest = 10000;       // degC
  constexpr double kLargestOffset = 1000;  // K
  return check("kelvin_per_count", s.kelvin_per_count, 0, 10)
      .and_then(
          [&] { return check("kelvin_offset", s.kelvin_offset, -kLargestOffset, kLargestOffset); })
      .and_then([&] { return check("wavelength (um)", s.wavelength, 0.1, 100); })
      .and_then([&] { return check("emissivity", s.emissivity.value_or(1), 0, 1); })
      .and_then([&] { return check("reflectivity", s.reflectivity.value_or(1), 0, 1); })
      .and_then(
          [&] { return check("surroundings (degC)", s.surroundings, -kZeroCelsius, kHottest); })
      .and_then([&] {
        return check("ball_temperature (degC)", s.ball_temperature, -kZeroCelsius, kHottest);
      });
}

}  // namespace

Result<Radiometry> Radiometry::make(const RadiometrySettings& settings) {
  if (settings.kelvin_per_count == 0) return Radiometry();
  if (auto checked = check(settings); !checked) return tl::unexpected(checked.error());
  return Radiometry(settings);
}

Radiometry::Radiometry(const RadiometrySettings& settings) : settings_(settings) {
  celsius_.reserve(kCounts + 1);
  for (std::size_t count = 0; count <= kCounts; ++count) {
    celsius_.push_back(static_cast<float>(exact_celsius(static_cast<double>(count))));
  }
}

double Radiometry::exact_celsius(double counts) const {
  const double camera =
      kelvin_of_counts(counts, settings_.kelvin_per_count, settings_.kelvin_offset);
  const double rho = reflectivity(), eps = emissivity(), um = settings_.wavelength;
  if (rho == 1 && eps == 1) return camera - kZeroCelsius;
  const double ball = radiance(um, settings_.ball_temperature + kZeroCelsius);
  const double around = radiance(um, settings_.surroundings + kZeroCelsius);
  const double scene = (radiance(um, camera) - (1 - rho) * ball) / rho;
  const double target = (scene - (1 - eps) * around) / eps;
  if (!(target > 0)) return std::numeric_limits<double>::quiet_NaN();
  return temperature(um, target) - kZeroCelsius;
}

double Radiometry::counts(double celsius) const {
  const double target = celsius + kZeroCelsius;
  const auto counts_of = [this](double kelvin) {
    return counts_of_kelvin(kelvin, settings_.kelvin_per_count, settings_.kelvin_offset);
  };
  const double rho = reflectivity(), eps = emissivity(), um = settings_.wavelength;
  if (rho == 1 && eps == 1) return counts_of(target);
  const double ball = radiance(um, settings_.ball_temperature + kZeroCelsius);
  const double around = radiance(um, settings_.surroundings + kZeroCelsius);
  const double scene = eps * radiance(um, target) + (1 - eps) * around;
  return counts_of(temperature(um, rho * scene + (1 - rho) * ball));
}

}  // namespace orbwatch::signals
