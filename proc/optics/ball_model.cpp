// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/ball_model.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

#include "proc/optics/vec.h"

namespace orbwatch::optics {

namespace laws {
#define ORBWATCH_DECLARE(kind, law) extern const BallLaw law;
ORBWATCH_BALL_MODELS(ORBWATCH_DECLARE)
#undef ORBWATCH_DECLARE
}  // namespace laws

namespace {

#define ORBWATCH_ADDRESS(kind, law) &laws::law,
constexpr std::array kLaws{ORBWATCH_BALL_MODELS(ORBWATCH_ADDRESS)};
#undef ORBWATCH_ADDRESS

Result<double> checked_alpha(double alpha) {
  if (alpha > 180 && alpha <= 360) return alpha;
  return fail("alpha is " + std::to_string(alpha) + " degrees; it must be in (180, 360]");
}

Result<double> checked_distance(double distance) {
  if (distance > 1) return distance;
  return fail("distance is " + std::to_string(distance) +
              " ball radii; it must be above 1: the camera stands outside the ball");
}

// sin(alpha/2), exact up to 360 degrees.
double inverse_distance(double alpha) { return std::sin(radians((360 - alpha) / 2)); }

}  // namespace

const BallLaw& law(BallModel::Kind kind) { return *kLaws[static_cast<std::size_t>(kind)]; }

BallModel::BallModel(Kind kind, double q) : kind_(kind), law_(&law(kind)), limb_(q) {}

BallModel BallModel::at_distance(Kind kind, double distance) {
  return {kind, law(kind).is_orthographic ? 0 : 1 / distance};
}

Result<BallModel> BallModel::make(Kind kind, std::optional<double> alpha,
                                  std::optional<double> distance) {
  if (law(kind).is_orthographic) {
    if (!alpha && !distance) return BallModel(kind, 0);
    return fail("the " + std::string(law(kind).name) + " model takes neither alpha nor distance");
  }
  if (alpha.has_value() == distance.has_value()) return fail("give either alpha or distance");
  if (distance) {
    return checked_distance(*distance).map([kind](double d) { return at_distance(kind, d); });
  }
  return checked_alpha(*alpha).map(
      [kind](double a) { return BallModel(kind, inverse_distance(a)); });
}

double BallModel::limit() const { return std::numbers::pi - std::asin(limb_.q); }

std::optional<CosSin> BallModel::phi(double rho) const {
  if (!(rho >= 0 && rho <= 1 + Limb::kTolerance)) return std::nullopt;
  return law_->phi(limb_, std::min(rho, 1.0));
}

CosSin BallModel::theta(double rho) const { return law_->theta(limb_, std::min(rho, 1.0)); }

}  // namespace orbwatch::optics
