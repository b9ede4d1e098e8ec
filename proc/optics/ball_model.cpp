#include "proc/optics/ball_model.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "proc/optics/angle.h"

namespace orbwatch::optics {
namespace {

Result<double> checked_alpha(double alpha) {
  if (alpha > 180 && alpha <= 360) return alpha;
  return fail("alpha is " + std::to_string(alpha) + " degrees; it must be in (180, 360]");
}

Result<double> checked_distance(double distance) {
  if (distance > 1) return distance;
  return fail("distance is " + std::to_string(distance) +
              " ball radii; it must be above 1: the camera stands outside the ball");
}

// sin(alpha/2), exact towards 360 degrees too.
double inverse_distance(double alpha) { return std::sin(radians((360 - alpha) / 2)); }

CosSin sum(const CosSin& a, const CosSin& b) {
  return {a.cos * b.cos - a.sin * b.sin, a.sin * b.cos + a.cos * b.sin};
}

}  // namespace

BallModel::BallModel(Kind kind, double q)
    : kind_(kind),
      q_(q),
      cos_limb_(std::sqrt((1 - q) * (1 + q))),
      widest_(std::sqrt((1 + cos_limb_) / 2)) {}

Result<BallModel> BallModel::exact(double alpha) {
  return checked_alpha(alpha).map(
      [](double a) { return BallModel(Kind::Exact, inverse_distance(a)); });
}

Result<BallModel> BallModel::paper(double alpha) {
  return checked_alpha(alpha).map(
      [](double a) { return BallModel(Kind::Paper, inverse_distance(a)); });
}

BallModel BallModel::classical() { return {Kind::Classical, 0}; }

BallModel BallModel::at_distance(Kind kind, double distance) {
  return kind == Kind::Classical ? classical() : BallModel(kind, 1 / distance);
}

Result<BallModel> BallModel::make(Kind kind, std::optional<double> alpha,
                                  std::optional<double> distance) {
  if (kind == Kind::Classical) {
    if (alpha || distance) return fail("the classical model takes neither alpha nor distance");
    return classical();
  }
  if (alpha.has_value() == distance.has_value()) return fail("give either alpha or distance");
  if (alpha) return kind == Kind::Exact ? exact(*alpha) : paper(*alpha);
  return checked_distance(*distance).map([kind](double d) { return at_distance(kind, d); });
}

Result<double> BallModel::alpha_from_distance(double distance) {
  return checked_distance(distance).map(
      [](double d) { return 360 - 2 * degrees(std::asin(1 / d)); });
}

Result<double> BallModel::distance_from_alpha(double alpha) {
  return checked_alpha(alpha).map([](double a) { return 1 / inverse_distance(a); });
}

double BallModel::limit() const { return std::numbers::pi - std::asin(q_); }

void BallModel::stretch(const Lanes& cos_phi, const Lanes& sin2_phi, const Lanes& closeness,
                        StretchLanes& out) const {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  if (kind_ != Kind::Exact) {
    for (std::size_t k = 0; k < kLanes; ++k) {
      const auto one = stretch(cos_phi[k], sin2_phi[k], closeness[k]);
      out.across[k] = one ? one->across : kNothing;
      out.along[k] = one ? one->along : kNothing;
    }
    return;
  }
  const BallModel model = *this;  // so that no store into `out` could change it
  HalfAngleLanes h;
  for (std::size_t k = 0; k < kLanes; ++k) h.set(k, half(cos_phi[k], sin2_phi[k]));
  OffsetLanes delta;
  bisector_offsets(h, closeness, q_, delta);
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Stretch one = model.stretch_at(h.at(k), delta.at(k));
    out.across[k] = one.across;
    out.along[k] = one.along;
  }
  for (std::size_t k = 0; k < kLanes; ++k) {
    out.along[k] = model.is_shown(cos_phi[k], closeness[k]) ? out.along[k] : kNothing;
  }
}

std::optional<CosSin> BallModel::phi(double rho) const {
  if (!(rho >= 0 && rho <= 1 + kLimbTolerance)) return std::nullopt;
  const double r = std::min(rho, 1.0);
  if (kind_ == Kind::Exact) return sum(theta(r), incidence(r));
  const double sine = r * widest_;
  const CosSin h{std::sqrt((1 - sine) * (1 + sine)), sine};
  return sum(h, h);
}

CosSin BallModel::theta(double rho) const {
  const double r = std::min(rho, 1.0);
  const CosSin i = incidence(r);
  // The triangle camera, ball's centre, hit point: theta = i - psi, sin psi = q sin i.
  return sum(i, {std::sqrt((1 - q_ * i.sin) * (1 + q_ * i.sin)), -q_ * i.sin});
}

CosSin BallModel::incidence(double rho) const {
  const double left = (1 - rho) * (1 + rho);
  const double scale = 1 / std::sqrt(1 - q_ * q_ * left);
  return {cos_limb_ * std::sqrt(left) * scale, rho * scale};
}

}  // namespace orbwatch::optics
