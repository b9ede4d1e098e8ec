#pragma once

#include <array>
#include <cmath>

#include "proc/remap/grid/coordinate.h"

/// The allowed and the estimated error of a patch against the exact map. In Q13 pixels.
namespace orbwatch::remap {

inline constexpr double kOnePixel = 1 << kFractionBits;
inline constexpr double kTolerated = kTolerance * kOnePixel;
/// What a patch's error may be by its nodes: the rest of the tolerance is for terms of higher order
/// than the fourth.
inline constexpr double kClose = 0.85 * kTolerated;

/// Share of the fourth difference of five nodes in a row that the error of fourth order is at most:
/// the largest of Lagrange's t (1-t) (1+t) (2-t) / 24.
inline constexpr double kFourthOrder = 0.0235;

inline double distance(const Coordinate& a, const Coordinate& b) {
  const double u = double{1} * a.u - b.u, v = double{1} * a.v - b.v;
  return std::sqrt(u * u + v * v);
}

inline double fourth_order_error(const std::array<Coordinate, 5>& row) {
  constexpr std::array kBinomial{1.0, -4.0, 6.0, -4.0, 1.0};
  double u = 0, v = 0;
  for (std::size_t k = 0; k < row.size(); ++k) {
    u += kBinomial[k] * row[k].u;
    v += kBinomial[k] * row[k].v;
  }
  return kFourthOrder * std::sqrt(u * u + v * v);
}

}  // namespace orbwatch::remap
