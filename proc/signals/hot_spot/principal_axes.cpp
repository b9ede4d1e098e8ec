// SPDX-License-Identifier: Apache-2.0
#include "proc/signals/hot_spot/principal_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace orbwatch::signals {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

/// Applies the rotation in the plane of axes p and q that makes a[p][q] zero to `a` and to `axes`,
/// whose columns become the eigenvectors.
void rotate(Matrix& a, Matrix& axes, std::size_t p, std::size_t q) {
  if (a[p][q] == 0) return;
  const double tau = (a[q][q] - a[p][p]) / (2 * a[p][q]);
  const double tangent = std::copysign(1.0, tau) / (std::abs(tau) + std::sqrt(1 + tau * tau));
  const double c = 1 / std::sqrt(1 + tangent * tangent), s = c * tangent;
  for (std::size_t k = 0; k < 3; ++k) {
    const double kp = a[k][p], kq = a[k][q];
    a[k][p] = c * kp - s * kq;
    a[k][q] = s * kp + c * kq;
  }
  for (std::size_t k = 0; k < 3; ++k) {
    const double pk = a[p][k], qk = a[q][k];
    a[p][k] = c * pk - s * qk;
    a[q][k] = s * pk + c * qk;
  }
  for (auto& row : axes) {
    const double kp = row[p], kq = row[q];
    row[p] = c * kp - s * kq;
    row[q] = s * kp + c * kq;
  }
}

}  // namespace

PrincipalAxes principal_axes(const Symmetric3& m) {
  constexpr int kSweeps = 8;  // convergence is quadratic: double precision after five
  Matrix a{{{m.xx, m.xy, m.xz}, {m.xy, m.yy, m.yz}, {m.xz, m.yz, m.zz}}};
  Matrix axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    rotate(a, axes, 0, 1);
    rotate(a, axes, 0, 2);
    rotate(a, axes, 1, 2);
  }
  std::array<std::size_t, 3> order{0, 1, 2};
  std::ranges::sort(order, [&](std::size_t i, std::size_t j) { return a[i][i] > a[j][j]; });
  const std::size_t first = order[0], second = order[1];
  return {{axes[0][first], axes[1][first], axes[2][first]},
          std::max(0.0, a[first][first]),
          std::max(0.0, a[second][second])};
}

}  // namespace orbwatch::signals
