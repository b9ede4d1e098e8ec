// SPDX-License-Identifier: Apache-2.0
#include "proc/optics/lens.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "proc/image/picture.h"

namespace orbwatch::optics {
namespace {

using Coefficients = std::array<double, 8>;

/// A radial function f at one place: f(r) / r and f'(r). Both are 0 at a pole.
struct Radial {
  double ratio;
  double slope;
};

Radial pinhole_radial(const Coefficients& k, double r2) {
  const auto& [k1, k2, p1, p2, k3, k4, k5, k6] = k;
  const double numerator = 1 + r2 * (k1 + r2 * (k2 + r2 * k3));
  const double denominator = 1 + r2 * (k4 + r2 * (k5 + r2 * k6));
  if (!(denominator > 0)) return {0, 0};
  const double ratio = numerator / denominator;
  const double numerator_slope = k1 + r2 * (2 * k2 + r2 * 3 * k3);
  const double denominator_slope = k4 + r2 * (2 * k5 + r2 * 3 * k6);
  return {ratio, ratio + 2 * r2 * (numerator_slope - ratio * denominator_slope) / denominator};
}

Radial fisheye_radial(const Coefficients& k, double angle) {
  const double a2 = angle * angle;
  return {1 + a2 * (k[0] + a2 * (k[1] + a2 * (k[2] + a2 * k[3]))),
          1 + a2 * (3 * k[0] + a2 * (5 * k[1] + a2 * (7 * k[2] + a2 * 9 * k[3])))};
}

/// The pinhole's distorted point and its derivative, which is symmetric: uu, uv, vv.
struct Distorted {
  Vec2 point;
  double uu, uv, vv;
};

Distorted distort(const Coefficients& k, const Vec2& x) {
  const double p1 = k[2], p2 = k[3];
  const double r2 = x.u * x.u + x.v * x.v;
  const Radial radial = pinhole_radial(k, r2);
  const double along = p2 * x.u + p1 * x.v;  // the decentring, times the radius
  const double scale = radial.ratio + 2 * along;
  // slope - ratio = r d(ratio)/dr: the part of the ratio's own change.
  const double change = r2 > 0 ? (radial.slope - radial.ratio) / r2 : 0;
  return {{x.u * scale + p2 * r2, x.v * scale + p1 * r2},
          scale + change * x.u * x.u + 4 * p2 * x.u,
          change * x.u * x.v + 2 * (p2 * x.v + p1 * x.u),
          scale + change * x.v * x.v + 4 * p1 * x.v};
}

/// True if the pinhole's distortion keeps its orientation everywhere at this radius: its
/// derivative, in directions along and across the radius
///   [ slope + 6 r a   2 r b         ]   with a^2 + b^2 = p1^2 + p2^2,
///   [ 2 r b           ratio + 2 r a ]
/// is positive definite. In a disc with this property no two points have the same image.
bool keeps_sense(const Coefficients& k, double r) {
  const Radial radial = pinhole_radial(k, r * r);
  const double decentring = r * std::hypot(k[2], k[3]);
  const double slope = radial.slope, ratio = radial.ratio;
  if (!(slope > 0) || !(ratio > 0) || !(ratio > 2 * decentring)) return false;
  // The determinant over c = a / hypot(p1, p2) is a parabola; its minimum in [-1, 1].
  const double linear = decentring * (2 * slope + 6 * ratio), square = 16 * decentring * decentring;
  const double c = 2 * square > linear ? -linear / (2 * square) : -1;
  return slope * ratio - square / 4 + c * (linear + c * square) > 0;
}

/// The largest x in [0, end] up to which `good` holds: a scan finds the first failure, a bisection
/// the place. `at` maps [0, 1] to the argument.
template <class At, class Good>
double last_good(const At& at, const Good& good) {
  constexpr int kSteps = 2000;
  int step = 1;
  while (step <= kSteps && good(at(double(step) / kSteps))) ++step;
  if (step > kSteps) return at(1);
  double low = double(step - 1) / kSteps, high = double(step) / kSteps;
  for (int i = 0; i < 50; ++i) {
    const double middle = (low + high) / 2;
    (good(at(middle)) ? low : high) = middle;
  }
  return at(low);
}

double fold(const Intrinsics& intrinsics) {
  const Coefficients& k = intrinsics.coefficients;
  switch (intrinsics.distortion) {
    case Distortion::None:
      break;
    case Distortion::Pinhole: {
      // No pinhole lens reaches 89.9 degrees from its axis; the scan ends there.
      const auto tangent = [](double share) { return std::tan(share * radians(89.9)); };
      return last_good(tangent, [&](double r) { return keeps_sense(k, r); });
    }
    case Distortion::Fisheye: {
      const auto angle = [](double share) { return share * std::numbers::pi; };
      return last_good(angle, [&](double a) { return fisheye_radial(k, a).slope > 0; });
    }
  }
  return std::numeric_limits<double>::infinity();
}

/// The point in the disc of radius `limit` whose distorted image is `target`. Newton's method: the
/// derivative is positive definite there, so that a step, halved often enough, always gets nearer.
std::optional<Vec2> undistort(const Coefficients& k, const Vec2& target, double limit) {
  const double size = std::hypot(target.u, target.v);
  const double start = std::min(1.0, 0.9 * limit / size);
  Vec2 x = size > 0 ? Vec2{target.u * start, target.v * start} : target;
  Distorted image = distort(k, x);
  const auto miss = [&](const Distorted& d) {
    return std::hypot(target.u - d.point.u, target.v - d.point.v);
  };
  double error = miss(image);
  for (int step = 0; step < 100 && error > 0; ++step) {
    const double du = target.u - image.point.u, dv = target.v - image.point.v;
    const double determinant = image.uu * image.vv - image.uv * image.uv;
    const Vec2 move{(image.vv * du - image.uv * dv) / determinant,
                    (image.uu * dv - image.uv * du) / determinant};
    bool nearer = false;
    for (double share = 1; share > 1e-6 && !nearer; share /= 2) {
      const Vec2 next{x.u + share * move.u, x.v + share * move.v};
      if (std::hypot(next.u, next.v) > limit) continue;
      const Distorted next_image = distort(k, next);
      nearer = miss(next_image) < error;
      if (!nearer) continue;
      x = next;
      image = next_image;
      error = miss(image);
    }
    if (!nearer) break;
  }
  // The remaining error is rounding, or the target lies beyond the fold.
  if (!(error <= 1e-12 * (size + 1e-3))) return std::nullopt;
  return x;
}

/// The angle up to `limit` whose distorted size is `target`: Newton's method within a bracket.
std::optional<double> undistort_angle(const Coefficients& k, double target, double limit) {
  double low = 0, high = limit;
  if (!(target <= limit * fisheye_radial(k, limit).ratio)) return std::nullopt;
  double angle = std::min(target, limit);
  for (int step = 0; step < 200; ++step) {
    const Radial radial = fisheye_radial(k, angle);
    const double error = angle * radial.ratio - target;
    (error > 0 ? high : low) = angle;
    const double next = angle - error / radial.slope;
    if (std::abs(next - angle) <= 1e-15 * angle) break;
    angle = next > low && next < high ? next : (low + high) / 2;
  }
  return angle;
}

Result<> check_numbers(const Intrinsics& i) {
  const auto side = [](int length) { return length >= 1 && length <= kMaxSide; };
  if (!side(i.width) || !side(i.height)) {
    return fail("the calibration's picture is " + std::to_string(i.width) + "x" +
                std::to_string(i.height) + "; sides must be 1 to " + std::to_string(kMaxSide));
  }
  if (!(i.fx > 0) || !(i.fy > 0) || !std::isfinite(i.fx) || !std::isfinite(i.fy)) {
    return fail("the focal lengths fx, fy must be above 0 pixels and finite");
  }
  if (!std::isfinite(i.cx) || !std::isfinite(i.cy)) {
    return fail("the principal point cx, cy must be finite");
  }
  const int used = i.distortion == Distortion::None      ? 0
                   : i.distortion == Distortion::Fisheye ? 4
                                                         : 8;
  for (int n = 0; n < 8; ++n) {
    const double k = i.coefficients[n];
    if (!std::isfinite(k)) return fail("the distortion's coefficients must be finite");
    if (n >= used && k != 0) {
      return fail("this distortion has " + std::to_string(used) +
                  " coefficients; the rest must be 0");
    }
  }
  return {};
}

}  // namespace

Lens::Lens(const Intrinsics& intrinsics)
    : intrinsics_(intrinsics),
      straight_(intrinsics.distortion != Distortion::Fisheye &&
                intrinsics.coefficients == Coefficients{}),
      limit_(straight_ ? std::numeric_limits<double>::infinity() : fold(intrinsics)) {}

Result<Lens> Lens::make(const Intrinsics& intrinsics) {
  if (auto checked = check_numbers(intrinsics); !checked) return tl::unexpected(checked.error());
  const Lens lens(intrinsics);
  const double shown = lens.limit_ * std::min(intrinsics.fx, intrinsics.fy);
  const double middle = 0.1 * std::min(intrinsics.width, intrinsics.height);
  if (!(shown > middle)) {
    return fail("the distortion folds the picture back " + std::to_string(shown) +
                " pixels from its principal point; it must be one to one for at least " +
                std::to_string(middle) + " pixels");
  }
  return lens;
}

std::optional<Vec2> Lens::distorted_pixel(const Vec3& direction) const {
  const Intrinsics& i = intrinsics_;
  Vec2 point;
  if (i.distortion == Distortion::Fisheye) {
    const double across = std::hypot(direction.x, direction.y);
    const double angle = std::atan2(across, direction.z);
    if (!(angle <= limit_) || (across == 0 && !(direction.z > 0))) return std::nullopt;
    // The angle equals the tangent on the axis; avoids a division by 0.
    const double scale =
        fisheye_radial(i.coefficients, angle).ratio * (across > 0 ? angle / across : 0);
    point = {direction.x * scale, direction.y * scale};
  } else {
    if (!(direction.z > 0)) return std::nullopt;
    const Vec2 tangent{direction.x / direction.z, direction.y / direction.z};
    if (!(std::hypot(tangent.u, tangent.v) <= limit_)) return std::nullopt;
    point = distort(i.coefficients, tangent).point;
  }
  return Vec2{i.fx * point.u + i.cx, i.fy * point.v + i.cy};
}

std::optional<Vec3> Lens::direction(const Vec2& pixel) const {
  const Intrinsics& i = intrinsics_;
  const Vec2 point{(pixel.u - i.cx) / i.fx, (pixel.v - i.cy) / i.fy};
  if (!std::isfinite(point.u) || !std::isfinite(point.v)) return std::nullopt;
  if (straight_) return normalized({point.u, point.v, 1});
  if (i.distortion == Distortion::Fisheye) {
    const double size = std::hypot(point.u, point.v);
    const auto angle = undistort_angle(i.coefficients, size, limit_);
    if (!angle) return std::nullopt;
    const double scale = size > 0 ? std::sin(*angle) / size : 0;
    return Vec3{point.u * scale, point.v * scale, std::cos(*angle)};
  }
  const auto tangent = undistort(i.coefficients, point, limit_);
  if (!tangent) return std::nullopt;
  return normalized({tangent->u, tangent->v, 1});
}

}  // namespace orbwatch::optics
