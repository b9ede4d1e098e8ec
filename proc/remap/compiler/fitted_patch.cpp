// SPDX-License-Identifier: Apache-2.0
#include "proc/remap/compiler/fitted_patch.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "proc/remap/compiler/tolerance.h"

namespace orbwatch::remap {
namespace {

/// Pixels that are fitted along each axis: close to the extremes of the third Chebyshev polynomial,
/// so that the largest error of a third-order map is least.
constexpr std::array kFitted{0, 4, 11, 15};
constexpr double kMiddle = (kTile - 1) / 2.0;

/// Mean over kFitted of a power of the distance from the middle.
constexpr double mean_power(int power) {
  double sum = 0;
  for (const int x : kFitted) {
    double value = 1;
    for (int k = 0; k < power; ++k) value *= x - kMiddle;
    sum += value;
  }
  return sum / kFitted.size();
}
constexpr double kSquare = mean_power(2), kSpread = mean_power(4) - kSquare * kSquare;

/// Terms that are orthogonal over the fitted pixels, as these are symmetric: 1, X, X^2 - mean.
struct Terms {
  explicit constexpr Terms(double x) : linear(x - kMiddle), square(linear * linear - kSquare) {}
  double linear, square;
};

/// One axis of a patch from the tile's middle, by least squares.
class FittedAxis {
 public:
  void add(double value, const Terms& x, const Terms& y) {
    constant_ += value;
    x_ += value * x.linear;
    y_ += value * y.linear;
    xy_ += value * x.linear * y.linear;
    xx_ += value * x.square;
    yy_ += value * y.square;
  }
  std::int32_t at(int column, int row) const {
    constexpr double kCount = kFitted.size() * kFitted.size();
    const Terms x(column), y(row);
    const double sum = constant_ + (x_ * x.linear + y_ * y.linear) / kSquare +
                       xy_ * x.linear * y.linear / (kSquare * kSquare) +
                       (xx_ * x.square + yy_ * y.square) / kSpread;
    return static_cast<std::int32_t>(std::lround(sum / kCount));
  }

 private:
  double constant_ = 0, x_ = 0, y_ = 0, xy_ = 0, xx_ = 0, yy_ = 0;
};

}  // namespace

Stencil fitted_nodes(const CoordinateTile& pixels) {
  FittedAxis u, v;
  for (const int y : kFitted) {
    for (const int x : kFitted) {
      u.add(pixels[y][x].u, Terms(x), Terms(y));
      v.add(pixels[y][x].v, Terms(x), Terms(y));
    }
  }
  Stencil nodes;
  for (int j = -1; j <= 2; ++j) {
    for (int i = -1; i <= 2; ++i) {
      nodes.at(i, j) = {u.at(i * kTile, j * kTile), v.at(i * kTile, j * kTile)};
    }
  }
  return nodes;
}

double largest_error(const Patch& patch, const CoordinateTile& pixels) {
  double largest = 0;
  for (int y = 0; y < kTile; ++y) {
    CoordinateRow row;
    patch.row(y).write(kTile, row.data());
    for (int x = 0; x < kTile; ++x) largest = std::max(largest, distance(row[x], pixels[y][x]));
  }
  return largest;
}

}  // namespace orbwatch::remap
