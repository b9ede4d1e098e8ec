// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <limits>

#include "proc/optics/models/ball_law.h"

// Reflection on a sphere in the picture of a perspective camera, for directions and for points.
namespace orbwatch::optics::laws {
namespace {

/// An angle delta as its cosine and sin(delta) / sin(h).
struct Offset {
  double cos;
  double share;
};

/// Finds the place on the ball where a camera and a point at the angle 2h from it see each other,
/// as the angle h + delta from the camera: Alhazen's problem. The law of reflection there,
///   sin 2 delta = p sin(h + delta) - q sin(h - delta),
/// p and q being the inverse distances, divided by cos delta sin h is
///   2 y = (p - q) + b y / cos delta,  y = sin delta / sin h,  b = (p + q) cos h.
/// For visible points the solution is the smallest y. The right side is convex up to there, so that
/// Newton's method climbs to it from any start below. The series in k = (p - q) / (2 - b) is such a
/// start, since all of its terms have k's sign, and mostly it is sufficient.
class Bisector {
 public:
  Bisector(const HalfAngle& h, double p, double q)
      : sin2_(h.sin2), a_(p - q), b_((p + q) * h.cos) {}
  Bisector(const HalfAngle& h, double p, double q, const Offset& from)
      : sin2_(h.sin2), a_(p - q), b_((p + q) * h.cos), y_(from.share), cosine_(from.cos) {}

  /// Starts with the series; true if it is sufficient.
  bool start() {
    const double scale = 1 / (2 - b_);
    const double k = a_ * scale, m = b_ * scale, kk = k * k * sin2_;
    const double third = m * (0.3125 + m * (1.5 + m * 1.5)) * kk * kk * kk;
    y_ = k * (1 + m * kk * (0.5 + (0.375 + 0.75 * m) * kk) + third);
    cosine_ = std::sqrt(1 - sin2_ * y_ * y_);
    constexpr double kNegligible = 1e-14;
    return std::abs(third) * kk * (1 + m) <= kNegligible;
  }

  /// One step of Newton's method; true if it is sufficient. Branch-free, for loops over many.
  bool improve() {
    const double square = cosine_ * cosine_;
    const double slope = 2 * cosine_ * square - b_;
    const double step = (b_ * y_ - (2 * y_ - a_) * cosine_) * square / slope;
    const double moved = ((slope > 0) & (std::abs(step) > 1e-16)) ? step : 0;
    y_ += moved;
    cosine_ = std::sqrt(1 - sin2_ * y_ * y_);
    const double negligible = slope > 0 ? 1e-8 * slope : std::numeric_limits<double>::infinity();
    return std::abs(moved) < negligible;
  }

  Offset offset() const { return {cosine_, y_}; }

 private:
  double sin2_, a_, b_;
  double y_ = 0;
  double cosine_ = 1;
};

/// Solves for one point: `p` and `q` are ball radius / distance of the point and of the camera.
Offset bisector_offset(const HalfAngle& h, double p, double q) {
  Bisector bisector(h, p, q);
  constexpr int kSteps = 60;  // a point that touches the ball is a double root: one bit per step
  bool enough = bisector.start();
  for (int i = 0; i < kSteps && !enough; ++i) enough = bisector.improve();
  return bisector.offset();
}

struct HalfAngleLanes {
  Lanes cos;
  Lanes sin2;

  HalfAngle at(std::size_t k) const { return {cos[k], sin2[k]}; }
  void set(std::size_t k, const HalfAngle& h) {
    cos[k] = h.cos;
    sin2[k] = h.sin2;
  }
};

struct OffsetLanes {
  Lanes cos;
  Lanes share;

  Offset at(std::size_t k) const { return {cos[k], share[k]}; }
  void set(std::size_t k, const Offset& offset) {
    cos[k] = offset.cos;
    share[k] = offset.share;
  }
};

/// bisector_offset() for kLanes points, bit-identical. One step per loop, branch-free, so that
/// compilers vectorize each.
void bisector_offsets(const HalfAngleLanes& h, const Lanes& p, double q, OffsetLanes& out) {
  OffsetLanes series, better;
  Lanes enough, settled;
  for (std::size_t k = 0; k < kLanes; ++k) {
    Bisector bisector(h.at(k), p[k], q);
    enough[k] = bisector.start() ? 1 : 0;
    series.set(k, bisector.offset());
  }
  if (std::all_of(enough.begin(), enough.end(), [](double yes) { return yes != 0; })) {
    out = series;
    return;
  }
  for (std::size_t k = 0; k < kLanes; ++k) {
    Bisector bisector(h.at(k), p[k], q, series.at(k));
    settled[k] = bisector.improve() ? 1 : 0;
    better.set(k, bisector.offset());
  }
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Offset first = series.at(k), second = better.at(k);
    out.set(k, enough[k] != 0 ? first : second);
  }
  for (std::size_t k = 0; k < kLanes; ++k) {
    if (enough[k] == 0 && settled[k] == 0) out.set(k, bisector_offset(h.at(k), p[k], q));
  }
}

// Branch-free like stretch_at(), for loops over many.
bool is_shown(const Limb& limb, double cos_phi, double closeness) {
  const double p = closeness;
  // A ray at the limb grazes the ball: phi = acos p + acos q.
  const double beyond = p * limb.q - cos_phi;
  const double limb2 = limb.cosine * limb.cosine * (1 - p) * (1 + p);
  return (p <= 1) & ((beyond <= 0) | (beyond * beyond <= limb2 + Limb::kTolerance));
}

Stretch stretch_at(const Limb& limb, const HalfAngle& h, const Offset& delta) {
  // The normal there; its sine is that of h times `sine`.
  const double cosine = h.cos * delta.cos - h.sin2 * delta.share;
  const double sine = delta.cos + h.cos * delta.share;
  return {limb.cosine * sine, 2 * h.cos * (1 - limb.q * cosine)};
}

std::optional<Stretch> stretch(const Limb& limb, double cos_phi, double sin2_phi,
                               double closeness) {
  if (!is_shown(limb, cos_phi, closeness)) return std::nullopt;
  const HalfAngle h = half(cos_phi, sin2_phi);
  return stretch_at(limb, h, bisector_offset(h, closeness, limb.q));
}

void stretch_lanes(const Limb& given, const Lanes& cos_phi, const Lanes& sin2_phi,
                   const Lanes& closeness, StretchLanes& out) {
  constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();
  const Limb limb = given;  // a copy, so that no store into `out` could change it
  HalfAngleLanes h;
  for (std::size_t k = 0; k < kLanes; ++k) h.set(k, half(cos_phi[k], sin2_phi[k]));
  OffsetLanes delta;
  bisector_offsets(h, closeness, limb.q, delta);
  for (std::size_t k = 0; k < kLanes; ++k) {
    const Stretch one = stretch_at(limb, h.at(k), delta.at(k));
    out.across[k] = one.across;
    out.along[k] = one.along;
  }
  for (std::size_t k = 0; k < kLanes; ++k) {
    out.along[k] = is_shown(limb, cos_phi[k], closeness[k]) ? out.along[k] : kNothing;
  }
}

CosSin incidence(const Limb& limb, double rho) {
  const double left = (1 - rho) * (1 + rho);
  const double scale = 1 / std::sqrt(1 - limb.q * limb.q * left);
  return {limb.cosine * std::sqrt(left) * scale, rho * scale};
}

CosSin theta(const Limb& limb, double rho) {
  const CosSin i = incidence(limb, rho);
  // Triangle of camera, ball's centre and hit point: theta = i - psi, sin psi = q sin i.
  return i + CosSin{std::sqrt((1 - limb.q * i.sin) * (1 + limb.q * i.sin)), -limb.q * i.sin};
}

CosSin phi(const Limb& limb, double rho) { return theta(limb, rho) + incidence(limb, rho); }

}  // namespace

extern const BallLaw exact;
constexpr BallLaw exact{"exact", "a sphere, seen by a perspective camera (default)",
                        false,   true,
                        stretch, stretch_lanes,
                        phi,     theta};

}  // namespace orbwatch::optics::laws
