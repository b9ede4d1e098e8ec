#include "proc/remap/patch.h"

#include <algorithm>
#include <cmath>

namespace orbwatch::remap {
namespace {

// The largest of x (16 - x).
constexpr std::int64_t kBulge = kTile * kTile / 4;

double third_order_error(const Stencil& stencil, std::int32_t Coordinate::*member) {
  const auto n = [&](int i, int j) { return static_cast<double>(stencil.at(i, j).*member); };
  const auto xx = [&](int i, int j) { return n(i - 1, j) - 2 * n(i, j) + n(i + 1, j); };
  const auto yy = [&](int i, int j) { return n(i, j - 1) - 2 * n(i, j) + n(i, j + 1); };
  const double x0 = xx(1, 0) - xx(0, 0), x1 = xx(1, 1) - xx(0, 1);
  const double y0 = yy(0, 1) - yy(0, 0), y1 = yy(1, 1) - yy(1, 0);
  const double across_x = (yy(1, 0) + yy(1, 1) - yy(0, 0) - yy(0, 1)) / 2;
  const double across_y = (xx(0, 1) + xx(1, 1) - xx(0, 0) - xx(1, 0)) / 2;
  return 0.0081 * (std::max(std::abs(x0), std::abs(x1)) + std::max(std::abs(y0), std::abs(y1))) +
         0.0625 * (std::abs(across_x) + std::abs(across_y));
}

}  // namespace

Patch::Axis::Axis(const Stencil& stencil, std::int32_t Coordinate::*member) {
  const auto n = [&](int i, int j) { return std::int64_t{stencil.at(i, j).*member}; };
  corner = n(0, 0);
  along_x = n(1, 0) - n(0, 0);
  along_y = n(0, 1) - n(0, 0);
  along_xy = n(1, 1) - n(0, 1) - along_x;
  xx = n(-1, 0) - n(0, 0) - n(1, 0) + n(2, 0) + n(-1, 1) - n(0, 1) - n(1, 1) + n(2, 1);
  yy = n(0, -1) - n(0, 0) - n(0, 1) + n(0, 2) + n(1, -1) - n(1, 0) - n(1, 1) + n(1, 2);
}

void Patch::Axis::row(int y, std::int64_t& value, std::int64_t& step, std::int64_t& curve) const {
  // f(x) = 8 (256 corner + 16 x along_x + 16 y along_y + x y along_xy)
  //        - x (16 - x) xx - y (16 - y) yy, in units of 1/2048
  value = 8 * kTile * (kTile * corner + y * along_y) - y * (kTile - y) * yy;
  curve = 2 * xx;
  step = 8 * (kTile * along_x + y * along_xy) - (kTile - 1) * xx;
}

std::int32_t Patch::Axis::low() const {
  const std::int64_t lowest = corner + std::min<std::int64_t>(along_x, 0);
  const std::int64_t below = corner + along_y + std::min<std::int64_t>(along_x + along_xy, 0);
  const std::int64_t bulge =
      kBulge * (std::max<std::int64_t>(xx, 0) + std::max<std::int64_t>(yy, 0));
  return static_cast<std::int32_t>(std::min(lowest, below) - (bulge >> PatchRow::kScaleBits) - 1);
}

std::int32_t Patch::Axis::high() const {
  const std::int64_t highest = corner + std::max<std::int64_t>(along_x, 0);
  const std::int64_t below = corner + along_y + std::max<std::int64_t>(along_x + along_xy, 0);
  const std::int64_t bulge =
      kBulge * (std::min<std::int64_t>(xx, 0) + std::min<std::int64_t>(yy, 0));
  return static_cast<std::int32_t>(std::max(highest, below) - (bulge >> PatchRow::kScaleBits) + 1);
}

Patch::Patch(const Stencil& stencil) : u_(stencil, &Coordinate::u), v_(stencil, &Coordinate::v) {}

PatchRow Patch::row(int y) const {
  PatchRow row{};
  u_.row(y, row.u, row.du, row.ddu);
  v_.row(y, row.v, row.dv, row.ddv);
  return row;
}

Coordinate Patch::at(int x, int y) const {
  PatchRow there = row(y);
  const std::int64_t steps = x, pairs = steps * (steps - 1) / 2;
  there.u += steps * there.du + pairs * there.ddu;
  there.v += steps * there.dv + pairs * there.ddv;
  return there.current();
}

Patch::Range Patch::range() const { return {{u_.low(), v_.low()}, {u_.high(), v_.high()}}; }

double third_order_error(const Stencil& stencil) {
  const double u = third_order_error(stencil, &Coordinate::u);
  const double v = third_order_error(stencil, &Coordinate::v);
  return std::sqrt(u * u + v * v);
}

}  // namespace orbwatch::remap
