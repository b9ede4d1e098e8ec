// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/grid/patch.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

namespace orbwatch::remap {
namespace {

constexpr int kTileBits = 4;
static_assert(kTile == 1 << kTileBits);
constexpr int kSlopeShift = PatchRow::kScaleBits - UvQuadratic::kSlopeBits;

/// Loads two nodes of a row.
UvXy32 two(const Coordinate* nodes) {
  static_assert(sizeof(Coordinate) == 8);
  UvXy32 pair;
  std::memcpy(&pair, nodes, sizeof pair);
  return pair;
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

/// The formula is
///   f(X, Y) = 8 (256 corner + 16 X along_x + 16 Y along_y + X Y along_xy)
///           - X (16 - X) xx - Y (16 - Y) yy, in units of 1/2048.
/// The second differences xx and yy are sums over the four corners.
Patch::Patch(PatchNodes nodes) {
  const auto [corner, stride] = nodes;
  const Coordinate* const below = corner + stride;
  const UvXy32 top = two(corner), bottom = two(below), middle = top + bottom;
  const auto outer = [](const Coordinate* row) {
    return __builtin_shufflevector(two(row - 1), two(row + 1), 0, 1, 6, 7);
  };
  const UvXy32 rows = outer(corner) + outer(below) - middle;
  const UvXy32 columns = two(corner - stride) + two(below + stride) - middle;
  const UvXy32 curve = __builtin_shufflevector(rows, columns, 0, 1, 4, 5) +
                       __builtin_shufflevector(rows, columns, 2, 3, 6, 7);
  const UvXy32 along = __builtin_shufflevector(top, bottom, 2, 3, 4, 5) -
                       __builtin_shufflevector(top, top, 0, 1, 0, 1);
  const UvXy32 down = bottom - top;
  const UvXy32 along_xy = __builtin_shufflevector(down, down, 2, 3, 2, 3) -
                          __builtin_shufflevector(down, down, 0, 1, 0, 1);
  constexpr int kStepBits = UvQuadratic::kSlopeBits - kTileBits;
  static_assert(kSlopeShift == kTileBits, "X (16 - X) xx: its slope is a shifted xx");
  axes_ = {Uv64{corner->u, corner->v} << PatchRow::kScaleBits, (along << kStepBits) - curve, curve,
           along_xy << (PatchRow::kScaleBits - 2 * kTileBits)};
}

Patch::Patch(const Quadratic& u, const Quadratic& v) {
  const auto four = [](std::int64_t u0, std::int64_t v0, std::int64_t u1, std::int64_t v1) {
    const auto narrow = [](std::int64_t value) { return static_cast<std::int32_t>(value); };
    return UvXy32{narrow(u0), narrow(v0), narrow(u1), narrow(v1)};
  };
  axes_ = UvQuadratic{
      {u.value, v.value},
      four(u.x >> kSlopeShift, v.x >> kSlopeShift, u.y >> kSlopeShift, v.y >> kSlopeShift),
      four(u.xx, v.xx, u.yy, v.yy),
      four(u.xy, v.xy, u.xy, v.xy)};
}

Quadratic Patch::axis(int n) const {
  const auto slope = [&](int lane) { return std::int64_t{axes_.slope[lane]} << kSlopeShift; };
  return {axes_.value[n], slope(n),       slope(n + 2),
          axes_.cross[n], axes_.curve[n], axes_.curve[n + 2]};
}

void PatchRow::write(int count, Coordinate* out) const {
  Uv64 value{u, v}, slope{du, dv};
  const Uv64 curve{ddu, ddv}, half = Uv64{} + (1 << (kScaleBits - 1));
  for (int x = 0; x < count; ++x) {
    const Uv64 rounded = (value + half) >> kScaleBits;
    out[x] = {static_cast<std::int32_t>(rounded[0]), static_cast<std::int32_t>(rounded[1])};
    value += slope;
    slope += curve;
  }
}

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

bool is_too_steep(const Stencil& stencil, int pixels) {
  const std::int64_t most = std::int64_t{kSteepest} * pixels << kFractionBits;
  const auto far = [&](int i, int j, int i2, int j2) {
    const Coordinate &a = stencil.at(i, j), &b = stencil.at(i2, j2);
    return std::abs(std::int64_t{a.u} - b.u) > most || std::abs(std::int64_t{a.v} - b.v) > most;
  };
  for (int along = -1; along <= 1; ++along) {
    for (int line = 0; line <= 1; ++line) {
      if (far(along, line, along + 1, line) || far(line, along, line, along + 1)) return true;
    }
  }
  return false;
}

}  // namespace orbwatch::remap
