// Reflection on a sphere as a perspective camera sees it, for directions and for points.

#include <algorithm>
#include <limits>

#include "proc/optics/models/alhazen.h"
#include "proc/optics/models/ball_law.h"

namespace orbwatch::optics::laws {
namespace {

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

/// bisector_offset() for many, with the same bits. One step per loop, without a branch, so that
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

// Without a branch, as stretch_at(): for loops over many.
bool is_shown(const Limb& limb, double cos_phi, double closeness) {
  const double p = closeness;
  // On the limb the ray grazes the ball: phi = acos p + acos q.
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
  const Limb limb = given;  // so that no store into `out` could change it
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
  // The triangle camera, ball's centre, hit point: theta = i - psi, sin psi = q sin i.
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
