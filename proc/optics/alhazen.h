#pragma once

#include <cmath>

/// Alhazen's problem: where on a ball two points outside of it see each other. In the header, since
/// grids are made of it. Reentrant.
namespace orbwatch::optics {

/// Half of an angle in [0, pi]. Neither number cancels where it counts: the cosine towards pi, the
/// square of the sine nowhere.
struct HalfAngle {
  double cos;
  double sin2;
};

/// `sin2`: square of the angle's sine, which its cosine does not tell near 0 and pi.
inline HalfAngle half(double cosine, double sin2) {
  const double cos2 = cosine >= 0 ? (1 + cosine) / 2 : sin2 / (2 * (1 - cosine));
  return {std::sqrt(cos2), (1 - cosine) / 2};
}

/// An angle delta by its cosine and by sin(delta) / sin(h).
struct Offset {
  double cos;
  double share;
};

/// The place on the ball where a camera and a point at the angle 2h from it see each other, as the
/// angle h + delta from the camera: Alhazen's problem. The law of reflection there,
///   sin 2 delta = p sin(h + delta) - q sin(h - delta),
/// p and q being the inverse distances, divided by cos delta sin h is
///   2 y = (p - q) + b y / cos delta,  y = sin delta / sin h,  b = (p + q) cos h.
/// For what the camera sees its solution is the smallest y. The right side is convex up to there,
/// so that Newton's method climbs to it from any start below; the series in k = (p - q) / (2 - b)
/// is one, since all of its terms have k's sign, and mostly it is enough.
inline Offset bisector_offset(const HalfAngle& h, double p, double q) {
  const double a = p - q, b = (p + q) * h.cos;
  const double scale = 1 / (2 - b);
  const double k = a * scale, m = b * scale, kk = k * k * h.sin2;
  const double third = m * (0.3125 + m * (1.5 + m * 1.5)) * kk * kk * kk;
  double y = k * (1 + m * kk * (0.5 + (0.375 + 0.75 * m) * kk) + third);
  double cosine = std::sqrt(1 - h.sin2 * y * y);
  constexpr double kNegligible = 1e-14;
  if (std::abs(third) * kk * (1 + m) <= kNegligible) return {cosine, y};
  constexpr int kSteps = 60;  // a point that touches the ball is a double root: one bit per step
  for (int i = 0; i < kSteps; ++i) {
    const double square = cosine * cosine;
    const double slope = 2 * cosine * square - b;
    const double step = (b * y - (2 * y - a) * cosine) * square / slope;
    if (!(slope > 0) || !(std::abs(step) > 1e-16)) break;
    y += step;
    cosine = std::sqrt(1 - h.sin2 * y * y);
    if (std::abs(step) < 1e-8 * slope) break;
  }
  return {cosine, y};
}

}  // namespace orbwatch::optics
