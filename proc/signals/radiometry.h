// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "proc/image/result.h"
#include "proc/settings/settings.h"

namespace orbwatch::signals {

/// Relation of a camera's counts to black-body temperature: T[K] = kelvin_per_count * count +
/// kelvin_offset.
struct RadiometrySettings {
  double kelvin_per_count = 0;           ///< 0: not stated
  bool states_scale = false;             ///< the camera itself reports kelvin_per_count
  double wavelength = 10;                ///< um, the camera's effective one
  std::optional<double> emissivity{};    ///< the target's emissivity, (0, 1]; nullopt: 1
  double surroundings = 20;              ///< degC, temperature reflected by the target
  std::optional<double> reflectivity{};  ///< the ball's reflectivity, (0, 1]; nullopt: 1
  double ball_temperature = 20;          ///< degC, for the ball's own emission
  double kelvin_offset = 0;              ///< K, at a count of 0

  bool is_radiometric() const { return kelvin_per_count > 0 || states_scale; }
};

/// Settings of a camera's table [camera.radiometry]; kelvin_per_count, kelvin_offset and
/// states_scale are keys of the camera's own table, the rest are the region's.
template <class Visitor>
void visit(Visitor& v, RadiometrySettings& radiometry) {
  v.require(radiometry.is_radiometric(), "wavelength",
            "only a camera with kelvin_per_count or radiometric = true is radiometric");
  v.optional("wavelength", radiometry.wavelength, Range::between(0.5, 20),
             "Effective wavelength of the camera's band, um");
  v.optional("ball_reflectivity", radiometry.reflectivity, Range::between(0.05, 1),
             "Reflectivity of the mirror ball at that wavelength; temperatures are apparent unless "
             "this key and the region's emissivity are set");
  v.optional("ball_temperature", radiometry.ball_temperature, Range::between(-273, 1000),
             "Temperature of the mirror ball, degC, to subtract its own emission");
}

/// Converts counts to the target's temperature and back, by
///   L(T camera) = rho L_scene + (1 - rho) L(T ball),
///   L_scene = eps L(T target) + (1 - eps) L(T surroundings),
/// where L is Planck's law at the camera's wavelength. With rho = eps = 1 both are the camera's own
/// linear scale exactly. Immutable; reentrant.
class Radiometry {
 public:
  /// An instance that is not radiometric.
  Radiometry() = default;

  /// Error: a number out of range; the message names it.
  static Result<Radiometry> make(const RadiometrySettings& settings);

  bool is_radiometric() const { return !celsius_.empty(); }

  /// True without the target's emissivity or the ball's reflectivity: temperatures are those of a
  /// black body, or of one seen without the ball.
  bool is_apparent() const { return !settings_.emissivity || !settings_.reflectivity; }

  /// degC of `counts` in [0, 65535], interpolated in a table; NaN for less light than ball and
  /// surroundings emit. Only for radiometric instances.
  double celsius(double counts) const {
    const auto whole = static_cast<std::size_t>(counts);
    const double below = celsius_[whole];
    return below + (counts - static_cast<double>(whole)) * (celsius_[whole + 1] - below);
  }

  /// The counts of a target at `celsius`, for thresholds; may lie below 0 or beyond 65535. Only for
  /// radiometric instances; not for the frame path.
  double counts(double celsius) const;

 private:
  explicit Radiometry(const RadiometrySettings& settings);

  double reflectivity() const { return settings_.reflectivity.value_or(1); }
  double emissivity() const { return settings_.emissivity.value_or(1); }
  double exact_celsius(double counts) const;

  RadiometrySettings settings_;
  std::vector<float> celsius_;  ///< indexed by whole counts, plus one more
};

}  // namespace orbwatch::signals
