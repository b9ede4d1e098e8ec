#include "proc/remap/patch.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::remap {
namespace {

constexpr int kTileBits = 4;
static_assert(kTile == 1 << kTileBits);

/// f(X, Y) = 8 (256 corner + 16 X along_x + 16 Y along_y + X Y along_xy)
///           - X (16 - X) xx - Y (16 - Y) yy, in units of 1/2048. The second differences xx and yy
/// are added up over the four corners.
BasicQuadratic<Both> quadratics(const Coordinate* nodes, std::ptrdiff_t stride) {
  const auto n = [&](int i, int j) {
    const Coordinate& node = nodes[j * stride + i];
    return Both{node.u, node.v};
  };
  const Both corner = n(0, 0), along_x = n(1, 0) - corner, along_y = n(0, 1) - corner;
  const Both along_xy = n(1, 1) - n(0, 1) - along_x;
  const Both middle = corner + n(1, 0) + n(0, 1) + n(1, 1);
  const Both xx = n(-1, 0) + n(2, 0) + n(-1, 1) + n(2, 1) - middle;
  const Both yy = n(0, -1) + n(0, 2) + n(1, -1) + n(1, 2) - middle;
  constexpr int kUnitBits = PatchRow::kScaleBits, kStepBits = kUnitBits - kTileBits;
  constexpr int kCornerBits = kStepBits - kTileBits;
  return {corner << kUnitBits,
          (along_x << kStepBits) - (xx << kTileBits),
          (along_y << kStepBits) - (yy << kTileBits),
          along_xy << kCornerBits,
          xx,
          yy};
}

struct Extremes {
  std::int32_t low;
  std::int32_t high;
};

/// Bounds of one axis: the bilinear part's corners, and the bulge between them, which is largest in
/// the middle, X (16 - X) = 64.
Extremes extremes(const Quadratic& axis) {
  constexpr std::int64_t kBulge = kTile * kTile / 4;
  const std::int64_t right = axis.x + kTile * axis.xx, down = axis.y + kTile * axis.yy;
  const std::int64_t top = axis.value, bottom = axis.value + kTile * down;
  const std::int64_t top_right = top + kTile * right;
  const std::int64_t bottom_right = bottom + kTile * (right + kTile * axis.xy);
  const std::int64_t low =
      std::min({top, bottom, top_right, bottom_right}) -
      kBulge * (std::max<std::int64_t>(axis.xx, 0) + std::max<std::int64_t>(axis.yy, 0));
  const std::int64_t high =
      std::max({top, bottom, top_right, bottom_right}) -
      kBulge * (std::min<std::int64_t>(axis.xx, 0) + std::min<std::int64_t>(axis.yy, 0));
  return {static_cast<std::int32_t>(low >> PatchRow::kScaleBits),
          static_cast<std::int32_t>((high >> PatchRow::kScaleBits) + 1)};
}

/// Values and their first two differences along row y.
struct Differences {
  std::int64_t value, step, curve;
};
Differences along_row(const Quadratic& axis, std::int64_t y) {
  return {axis.value + y * (axis.y + y * axis.yy), axis.x + y * axis.xy + axis.xx, 2 * axis.xx};
}

double third_order_error(const Stencil& stencil, std::int32_t Coordinate::*member) {
  const auto n = [&](int i, int j) { return static_cast<double>(stencil.at(i, j).*member); };
  const auto xx = [&](int i, int j) { return n(i - 1, j) - 2 * n(i, j) + n(i + 1, j); };
  const auto yy = [&](int i, int j) { return n(i, j - 1) - 2 * n(i, j) + n(i, j + 1); };
  const double x0 = xx(1, 0) - xx(0, 0), x1 = xx(1, 1) - xx(0, 1);
  const double y0 = yy(0, 1) - yy(0, 0), y1 = yy(1, 1) - yy(1, 0);
  const double across_x = (yy(1, 0) + yy(1, 1) - yy(0, 0) - yy(0, 1)) / 2;
  const double across_y = (xx(0, 1) + xx(1, 1) - xx(0, 0) - xx(1, 0)) / 2;
  return kThirdDifference *
             (std::max(std::abs(x0), std::abs(x1)) + std::max(std::abs(y0), std::abs(y1))) +
         kChangeAcross * (std::abs(across_x) + std::abs(across_y));
}

}  // namespace

Patch::Patch(const Coordinate* corner, std::ptrdiff_t stride) : axes_(quadratics(corner, stride)) {}

PatchRow Patch::row(int y) const {
  const Differences u = along_row(axis(0), y), v = along_row(axis(1), y);
  return {u.value, u.step, u.curve, v.value, v.step, v.curve};
}

Coordinate Patch::at(int x, int y) const {
  PatchRow there = row(y);
  const std::int64_t steps = x, pairs = steps * (steps - 1) / 2;
  there.u += steps * there.du + pairs * there.ddu;
  there.v += steps * there.dv + pairs * there.ddv;
  return there.current();
}

Patch::Range Patch::range() const {
  const Extremes u = extremes(axis(0)), v = extremes(axis(1));
  return {{u.low, v.low}, {u.high, v.high}};
}

double third_order_error(const Stencil& stencil) {
  const double u = third_order_error(stencil, &Coordinate::u);
  const double v = third_order_error(stencil, &Coordinate::v);
  return std::sqrt(u * u + v * v);
}

}  // namespace orbwatch::remap
