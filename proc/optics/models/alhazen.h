#pragma once

#include <cmath>
#include <limits>

/// Alhazen's problem: where on a ball two points outside of it see each other. Reentrant.
namespace orbwatch::optics {

/// Half of an angle in [0, pi]. Both numbers keep their relative precision, the cosine towards pi
/// too.
struct HalfAngle {
  double cos;
  double sin2;
};

/// `sin2`: square of the angle's sine, which its cosine does not determine near 0 and pi.
inline HalfAngle half(double cosine, double sin2) {
  const double cos2 = cosine >= 0 ? (1 + cosine) / 2 : sin2 / (2 * (1 - cosine));
  return {std::sqrt(cos2), (1 - cosine) / 2};
}

/// An angle delta by its cosine and by sin(delta) / sin(h).
struct Offset {
  double cos;
  double share;
};

/// Finds the place on the ball where a camera and a point at the angle 2h from it see each other,
/// as the angle h + delta from the camera: Alhazen's problem. The law of reflection there,
///   sin 2 delta = p sin(h + delta) - q sin(h - delta),
/// p and q being the inverse distances, divided by cos delta sin h is
///   2 y = (p - q) + b y / cos delta,  y = sin delta / sin h,  b = (p + q) cos h.
/// For visible points the solution is the smallest y. The right side is convex up to there,
/// so that Newton's method climbs to it from any start below; the series in k = (p - q) / (2 - b)
/// is one, since all of its terms have k's sign, and mostly it is enough.
class Bisector {
 public:
  Bisector(const HalfAngle& h, double p, double q)
      : sin2_(h.sin2), a_(p - q), b_((p + q) * h.cos) {}
  Bisector(const HalfAngle& h, double p, double q, const Offset& from)
      : sin2_(h.sin2), a_(p - q), b_((p + q) * h.cos), y_(from.share), cosine_(from.cos) {}

  /// Starts with the series; whether it is enough.
  bool start() {
    const double scale = 1 / (2 - b_);
    const double k = a_ * scale, m = b_ * scale, kk = k * k * sin2_;
    const double third = m * (0.3125 + m * (1.5 + m * 1.5)) * kk * kk * kk;
    y_ = k * (1 + m * kk * (0.5 + (0.375 + 0.75 * m) * kk) + third);
    cosine_ = std::sqrt(1 - sin2_ * y_ * y_);
    constexpr double kNegligible = 1e-14;
    return std::abs(third) * kk * (1 + m) <= kNegligible;
  }

  /// One step of Newton's; whether that is enough. Without a branch, for loops over many.
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

/// Solved: `p` and `q` are ball radius / distance of the point and of the camera.
inline Offset bisector_offset(const HalfAngle& h, double p, double q) {
  Bisector bisector(h, p, q);
  constexpr int kSteps = 60;  // a point that touches the ball is a double root: one bit per step
  bool enough = bisector.start();
  for (int i = 0; i < kSteps && !enough; ++i) enough = bisector.improve();
  return bisector.offset();
}

}  // namespace orbwatch::optics
