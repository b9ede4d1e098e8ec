// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string_view>

#include "proc/optics/lanes.h"

namespace orbwatch::optics {

/// An angle as its cosine and sine, which is what reflection needs.
struct CosSin {
  double cos = 1;
  double sin = 0;
};
constexpr CosSin operator+(const CosSin& a, const CosSin& b) {
  return {a.cos * b.cos - a.sin * b.sin, a.sin * b.cos + a.cos * b.sin};
}

/// rho / sin(phi) = across / along: a fraction, so that callers that divide later need not do it
/// twice. `along` is 0 straight behind the ball of an orthographic camera, where rho is 1.
struct Stretch {
  double across;
  double along;
};
struct StretchLanes {
  Lanes across;
  Lanes along;
};

/// The ball's limb relative to its camera.
struct Limb {
  /// `inverse_distance`: ball radius / distance of the camera, [0, 1).
  explicit Limb(double inverse_distance)
      : q(inverse_distance),
        cosine(std::sqrt((1 - q) * (1 + q))),
        widest(std::sqrt((1 + cosine) / 2)) {}

  double q;       ///< inverse distance = sin(alpha/2) = sin psi_max
  double cosine;  ///< cos psi_max = -cos(alpha/2)
  double widest;  ///< sin(alpha/4)

  // Keeps a direction exactly on the limb inside in spite of rounding.
  static constexpr double kTolerance = 1e-12;
};

/// The functions of a ball model; BallModel documents symbols and units. Functions are reentrant.
struct BallLaw {
  std::string_view name;  ///< name in files and options
  std::string_view text;  ///< description for manuals
  bool is_orthographic;   ///< the camera is infinitely far away
  bool has_parallax;      ///< knows where rays leave the ball; else everything is far away
  std::optional<Stretch> (*stretch)(const Limb&, double cos_phi, double sin2_phi, double closeness);
  /// The same for kLanes directions; `along` is NaN for nullopt.
  void (*stretch_lanes)(const Limb&, const Lanes& cos_phi, const Lanes& sin2_phi,
                        const Lanes& closeness, StretchLanes& out);
  /// Defined for rho in [0, 1].
  CosSin (*phi)(const Limb&, double rho);
  CosSin (*theta)(const Limb&, double rho);  ///< null without parallax
};

/// Half of an angle in [0, pi]. Both numbers keep their relative precision, the cosine also near
/// pi.
struct HalfAngle {
  double cos;
  double sin2;
};

/// Halves an angle. `sin2`: square of the angle's sine, which its cosine does not determine near 0
/// and pi.
inline HalfAngle half(double cosine, double sin2) {
  const double cos2 = cosine >= 0 ? (1 + cosine) / 2 : sin2 / (2 * (1 - cosine));
  return {std::sqrt(cos2), (1 - cosine) / 2};
}

}  // namespace orbwatch::optics
