// SPDX-License-Identifier: Apache-2.0
// Models whose rho is proportional to sin(phi/2), with everything far away: the paper's term rho =
// sin(phi/2) / sin(alpha/4), and its limit for alpha = 360, the orthographic camera.

#include <limits>

#include "proc/optics/models/ball_law.h"

namespace orbwatch::optics::laws {
namespace {

std::optional<Stretch> stretch(const Limb& limb, double cos_phi, double sin2_phi,
                               double /*closeness*/) {
  if (!(cos_phi >= -limb.cosine - Limb::kTolerance)) return std::nullopt;
  return Stretch{1, 2 * half(cos_phi, sin2_phi).cos * limb.widest};
}

void stretch_lanes(const Limb& limb, const Lanes& cos_phi, const Lanes& sin2_phi,
                   const Lanes& closeness, StretchLanes& out) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < kLanes; ++k) {
    const auto one = stretch(limb, cos_phi[k], sin2_phi[k], closeness[k]);
    out.across[k] = one ? one->across : kNothing;
    out.along[k] = one ? one->along : kNothing;
  }
}

CosSin phi(const Limb& limb, double rho) {
  const double sine = rho * limb.widest;
  const CosSin h{std::sqrt((1 - sine) * (1 + sine)), sine};
  return h + h;
}

}  // namespace

extern const BallLaw paper;
constexpr BallLaw paper{"paper", "rho = sin(phi/2) / sin(alpha/4), scene far away",
                        false,   false,
                        stretch, stretch_lanes,
                        phi,     nullptr};

extern const BallLaw classical;
constexpr BallLaw classical{"classical", "orthographic, takes neither alpha nor distance",
                            true,        false,
                            stretch,     stretch_lanes,
                            phi,         nullptr};

}  // namespace orbwatch::optics::laws
