#include "proc/optics/ball_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "proc/optics/angle.h"

namespace orbwatch::optics {
namespace {

constexpr double kUndefined = std::numeric_limits<double>::quiet_NaN();

// A direction exactly on the limb must not fall outside by rounding.
constexpr double kLimbTolerance = 1e-12;

Result<double> checked_alpha(double alpha) {
  if (alpha > 180 && alpha <= 360) return alpha;
  return fail("alpha is " + std::to_string(alpha) + " degrees; it must be in (180, 360]");
}

}  // namespace

BallModel::BallModel(Kind kind, double alpha)
    : kind_(kind),
      limit_(radians(alpha / 2)),
      inverse_distance_(alpha == 360 ? 0 : std::sin(radians(alpha / 2))),
      closed_form_(std::cos(radians(alpha / 4))),
      stretch_(std::sin(radians(alpha / 4))) {}

Result<BallModel> BallModel::exact(double alpha) {
  return checked_alpha(alpha).map([](double a) { return BallModel(Kind::Exact, a); });
}

Result<BallModel> BallModel::paper(double alpha) {
  return checked_alpha(alpha).map([](double a) { return BallModel(Kind::Paper, a); });
}

BallModel BallModel::classical() { return {Kind::Classical, 360}; }

Result<BallModel> BallModel::make(Kind kind, std::optional<double> alpha,
                                  std::optional<double> distance) {
  if (kind == Kind::Classical) {
    if (alpha || distance) return fail("the classical model takes neither alpha nor distance");
    return classical();
  }
  if (alpha.has_value() == distance.has_value()) return fail("give either alpha or distance");
  const Result<double> given = alpha ? Result<double>(*alpha) : alpha_from_distance(*distance);
  if (!given) return tl::unexpected(given.error());
  return kind == Kind::Exact ? exact(*given) : paper(*given);
}

Result<double> BallModel::alpha_from_distance(double distance) {
  if (!(distance > 1)) {
    return fail("distance is " + std::to_string(distance) +
                " ball radii; it must be above 1: the camera stands outside the ball");
  }
  return 360 - 2 * degrees(std::asin(1 / distance));
}

double BallModel::rho(double phi) const {
  if (!(phi <= limit_ + kLimbTolerance)) return kUndefined;
  if (kind_ == Kind::Exact) return std::min(1.0, exact_rho(phi));
  return std::min(1.0, std::sin(phi / 2) / stretch_);
}

double BallModel::exact_rho(double phi) const {
  const double q = inverse_distance_;
  // Closed form within 1 degree of the root from d = 3 on, then Newton on
  // f(i) = 2i - asin(q sin i) - phi, which is monotone.
  const double psi =
      2 * std::atan2(closed_form_ * std::sin(phi / 2), 1 - closed_form_ * std::cos(phi / 2));
  double i = std::min((phi + psi) / 2, std::numbers::pi / 2);
  for (int step = 0; step < 8; ++step) {
    const double sin_psi = q * std::sin(i);
    const double error = 2 * i - std::asin(sin_psi) - phi;
    const double slope = 2 - q * std::cos(i) / std::sqrt(1 - sin_psi * sin_psi);
    i -= error / slope;
    if (std::abs(error) < 1e-14) break;
  }
  // rho = tan psi / tan psi_max, written so that it holds for q = 0 too.
  const double sin_i = std::sin(std::min(i, std::numbers::pi / 2));
  return sin_i * std::sqrt((1 - q * q) / (1 - q * q * sin_i * sin_i));
}

double BallModel::phi(double rho) const {
  if (!(rho >= 0 && rho <= 1 + kLimbTolerance)) return kUndefined;
  const double r = std::min(rho, 1.0);
  if (kind_ != Kind::Exact) return 2 * std::asin(std::min(1.0, r * stretch_));
  const double q = inverse_distance_;
  const double sin_i = r / std::sqrt(1 - q * q + q * q * r * r);
  return 2 * std::asin(std::min(1.0, sin_i)) - std::asin(std::min(1.0, q * sin_i));
}

}  // namespace orbwatch::optics
